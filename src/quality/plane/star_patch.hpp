// SPDX-License-Identifier: BSD-3-Clause
// A copy of the rings of nodes around one node with their triangles. Indices in the patch follow
// the ids of the nodes, so the patch has the same bits on every rank.
#pragma once

#include <cstdint>
#include <vector>

#include "base/nodes.hpp"
#include "delaunay/delaunay_stars.hpp"
#include "quality/plane/local_mesh.hpp"

namespace pnpbs {

// The local mesh around one node, and the ids of its nodes.
class StarPatch {
 public:
  // Copies method::kPatchRings rings around `centre`. Returns false if one of the required stars is
  // not known.
  bool cut_out(const Nodes<2>& nodes, const DelaunayStars& stars, std::int64_t centre);

  const LocalMesh& mesh() const { return mesh_; }
  // Returns the index in mesh() of the node with this id, or -1.
  std::int32_t place_of(std::int64_t id) const;

 private:
  // A node of the patch, by its id and its index in the level.
  struct Member {
    std::int64_t id, node;
    bool inside;  // false: in the last ring
  };

  void add_triangles(const Nodes<2>& nodes, const DelaunayStars& stars);

  std::vector<Member> members_;  // sorted by id
  LocalMesh mesh_;
};

}  // namespace pnpbs
