// SPDX-License-Identifier: BSD-3-Clause
#include "check/flat_elements.hpp"

#include <array>

#include "delaunay/volume/circumsphere.hpp"
#include "results/own_elements.hpp"

namespace pnpbs {

namespace {

bool is_flat(const Tetrahedron& t, const std::array<std::int64_t, 4>&) {
  return circumsphere({t[0].x, t[1].x, t[2].x, t[3].x}).flat;
}

}  // namespace

FoundNodes<3> flat_elements(const Level<3>& level, std::vector<Point<3>>& places) {
  FoundNodes<3> found;
  for_own_elements_where("pnpbs::flat_elements", level, is_flat,
                         [&](const Tetrahedron& t, const std::array<std::int64_t, 4>&) {
                           found.add(1, t[0].id, t[0].x);
                           for (const VolumeNode& corner : t) places.push_back(corner.x);
                         });
  return over_ranks(*level.comm, found);
}

}  // namespace pnpbs
