// SPDX-License-Identifier: BSD-3-Clause
// One rank's own nodes and triangles, with the ghosts that these need; numbered by itself.
#pragma once

#include "io/node_source.hpp"
#include "placement/placement_of.hpp"

namespace pnpbs::io {

class OwnPiece : public NodeSource {
 public:
  // Local, after rows.hpp's prepare.
  OwnPiece(const PlacementOf<2>& placement, bool elements);

  // Local.
  void for_nodes(const std::function<void(const NodeRows&)>& visit) const override;
  void for_triangles(const std::function<void(const TriangleRows&)>& visit) const override;
  void for_edges(const std::function<void(const EdgeRows&)>&) const override {}  // has none

 private:
  const PlacementOf<2>& placement_;
  std::int64_t owned_;
  // Ghosts in the order in which triangles ask for them.
  std::vector<std::int64_t> ghosts_;  // places
  std::vector<std::int64_t> number_;  // of each ghost, by its place among them; -1: not needed
};

}  // namespace pnpbs::io
