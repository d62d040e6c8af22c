// SPDX-License-Identifier: BSD-3-Clause
// The rings of nodes around one, cut out of the stars. The same bits on every rank that knows them:
// places follow the ids.
#pragma once

#include <cstdint>
#include <vector>

#include "base/nodes.hpp"
#include "delaunay/delaunay_stars.hpp"
#include "quality/plane/local_mesh.hpp"

namespace pnpbs {

class StarPatch {
 public:
  // False if one of the stars is not there.
  bool cut_out(const Nodes<2>& nodes, const DelaunayStars& stars, std::int64_t centre);

  const LocalMesh& mesh() const { return mesh_; }
  std::int32_t place_of(std::int64_t id) const;

 private:
  struct Member {
    std::int64_t id, node;
    bool inside;  // not of the last ring
  };

  void add_triangles(const Nodes<2>& nodes, const DelaunayStars& stars);

  std::vector<Member> members_;  // by id
  LocalMesh mesh_;
};

}  // namespace pnpbs
