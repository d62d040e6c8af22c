// SPDX-License-Identifier: BSD-3-Clause
// Messages between ranks about the moves that repair slivers.
#include <algorithm>

#include "quality/volume/sliver_repair.hpp"

namespace pnpbs {

std::vector<std::int32_t> SliverRepair::drawn_corners() const {
  std::vector<std::int32_t> corners;
  for (const Attempt& attempt : attempts_) corners.push_back(attempt.corner);
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

std::vector<SliverDraw> SliverRepair::draws_of(std::int32_t corner) const {
  std::vector<SliverDraw> draws;
  for (const Attempt& attempt : attempts_)
    if (attempt.corner == corner)
      draws.push_back({attempt.lot, attempt.ids, nodes_.id(attempt.node)});
  return draws;
}

void SliverRepair::take(const std::vector<SliverDraw>& draws) {
  for (const SliverDraw& draw : draws) {
    const std::int32_t node = index_by_id_.of(draw.node);
    if (node < 0) continue;  // too far from the owned nodes to matter
    TetrahedronNodes sliver;
    for (std::size_t k = 0; k < 4; ++k) sliver[k] = index_by_id_.of(draw.sliver[k]);
    const bool known = std::ranges::find(sliver, -1) == sliver.end();
    if (nodes_.owned(node) && !known) {
      ++unknown_draws_;
      continue;
    }
    attempts_.push_back({draw.lot, draw.sliver, sliver, node, -1, {}});
  }
}

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

// Tetrahedra with corners unknown to this rank are skipped: the stars of these corners need not be
// valid here.
void SliverRepair::follow(const std::vector<ChangedTetrahedron>& news) {
  std::vector<StarChange> changes;
  for (const ChangedTetrahedron& record : news) {
    const std::int32_t node = index_by_id_.of(record.node);
    if (node < 0) continue;
    if (changes.empty() || changes.back().node != node)
      changes.push_back({node, record.x, {}, {}, record.on});
    TetrahedronNodes corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = index_by_id_.of(record.corners[k]);
    if (std::find(corners.begin(), corners.end(), -1) == corners.end())
      (record.made ? changes.back().made : changes.back().gone).push_back(corners);
  }
  accept(changes);
}

}  // namespace pnpbs
