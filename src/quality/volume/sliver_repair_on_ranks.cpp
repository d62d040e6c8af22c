// SPDX-License-Identifier: BSD-3-Clause
// What ranks tell each other of the moves that repair slivers.
#include <algorithm>

#include "quality/volume/sliver_repair.hpp"

namespace pnpbs {

std::vector<ChangedTetrahedron> SliverRepair::changes_of(std::int32_t node) const {
  std::vector<ChangedTetrahedron> changed;
  for (const StarChange& change : changes_) {
    if (change.node != node) continue;
    const auto add = [&](const std::vector<TetrahedronNodes>& tetrahedra, bool made) {
      for (const TetrahedronNodes& t : tetrahedra) {
        ChangedTetrahedron record{nodes_.id(node), change.x, {}, change.on, made};
        for (std::size_t k = 0; k < 4; ++k) record.corners[k] = nodes_.id(t[k]);
        changed.push_back(record);
      }
    };
    add(change.gone, false);
    add(change.made, true);
  }
  return changed;
}

std::vector<std::int32_t> SliverRepair::moved_nodes() const {
  std::vector<std::int32_t> moved;
  for (const StarChange& change : changes_) moved.push_back(change.node);
  return moved;
}

// Of tetrahedra with corners that are not known here the stars need not be right.
void SliverRepair::follow(const std::vector<ChangedTetrahedron>& news) {
  const auto place = [&](std::int64_t id) {
    const auto found = place_of_id_.find(id);
    return found == place_of_id_.end() ? -1 : found->second;
  };
  std::vector<StarChange> changes;
  for (const ChangedTetrahedron& record : news) {
    const std::int32_t node = place(record.node);
    if (node < 0) continue;
    if (changes.empty() || changes.back().node != node)
      changes.push_back({node, record.x, {}, {}, record.on});
    TetrahedronNodes corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = place(record.corners[k]);
    if (std::find(corners.begin(), corners.end(), -1) == corners.end())
      (record.made ? changes.back().made : changes.back().gone).push_back(corners);
  }
  accept(changes);
}

}  // namespace pnpbs
