// SPDX-License-Identifier: BSD-3-Clause
#include "quality/plane/star_patch.hpp"

#include <algorithm>

#include "method/constants.hpp"
#include "neighbors/rings.hpp"

namespace pnpbs {

bool StarPatch::cut_out(const Nodes<2>& nodes, const DelaunayStars& stars, std::int64_t centre) {
  members_.clear();
  const auto add = [&](std::int64_t i, int ring) {
    members_.push_back({nodes.id(i), i, ring < method::kPatchRings});
    return ring == method::kPatchRings || stars.needs(i) == 0;
  };
  if (!add(centre, 0) || !for_rings(stars, centre, method::kPatchRings, add)) return false;
  std::sort(members_.begin(), members_.end(),
            [](const Member& a, const Member& b) { return a.id < b.id; });
  mesh_.clear();
  for (const Member& member : members_)
    mesh_.add_node(nodes.position(member.node), member.inside && nodes.moves(member.node));
  add_triangles(nodes, stars);
  return true;
}

std::int32_t StarPatch::place_of(std::int64_t id) const {
  const auto found = std::lower_bound(
      members_.begin(), members_.end(), id,
      [](const Member& member, std::int64_t wanted) { return member.id < wanted; });
  return found != members_.end() && found->id == id
             ? static_cast<std::int32_t>(found - members_.begin())
             : -1;
}

// Adds the triangles that have a corner inside. Each is added from its inside corner with the
// smallest id.
void StarPatch::add_triangles(const Nodes<2>& nodes, const DelaunayStars& stars) {
  std::vector<LocalMesh::Corners> triangles;
  for (std::int32_t a = 0; a < static_cast<std::int32_t>(members_.size()); ++a) {
    const Member& member = members_[static_cast<std::size_t>(a)];
    if (!member.inside) continue;
    const auto first_from_a = [&](std::int32_t place) {
      return place > a || !members_[static_cast<std::size_t>(place)].inside;
    };
    stars.for_simplices(member.node, [&](const DelaunayStars::Corners& others) {
      const std::int32_t b = place_of(nodes.id(others[0])), c = place_of(nodes.id(others[1]));
      if (first_from_a(b) && first_from_a(c)) triangles.push_back({a, b, c});
    });
  }
  std::sort(triangles.begin(), triangles.end());
  for (const LocalMesh::Corners& corners : triangles) mesh_.add_triangle(corners);
  mesh_.link_triangles();
}

}  // namespace pnpbs
