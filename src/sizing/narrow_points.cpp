// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/narrow_points.hpp"

#include <algorithm>

#include "spacing/resolving_sources.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

namespace {

// The resolution for unresolved shapes: one layer of d across walls and gaps. One round reduces d
// to no less than 0.3 d, because a complete reduction at once takes more nodes than most points
// require.
constexpr Resolution kApart{1, 1, 0.3};

// The union of balls around points with their d as radius. `places` must outlive this object.
class Surroundings {
 public:
  explicit Surroundings(const std::vector<GrowthSource<3>>& places)
      : places_(places), tree_(boxes(places)) {}

  bool hold(const Point<3>& x) const {
    bool found = false;
    tree_.for_holding(x, [&](std::int32_t p) {
      const GrowthSource<3>& place = places_[static_cast<std::size_t>(p)];
      found = found || distance<3>(place.x, x) < place.d;
    });
    return found;
  }

 private:
  static std::vector<Box<3>> boxes(const std::vector<GrowthSource<3>>& places) {
    std::vector<Box<3>> result;
    for (const GrowthSource<3>& place : places) {
      Box<3> box{place.x, place.x};
      for (std::size_t k = 0; k < 3; ++k) box.low[k] -= place.d, box.high[k] += place.d;
      result.push_back(box);
    }
    return result;
  }

  const std::vector<GrowthSource<3>>& places_;
  BoxTree<3> tree_;
};

}  // namespace

std::vector<GrowthSource<2>> narrow_points(const Level<2>&, const std::vector<GrowthSource<2>>&) {
  return {};
}

std::vector<GrowthSource<3>> narrow_points(const Level<3>& level,
                                           const std::vector<GrowthSource<3>>& near) {
  std::vector<GrowthSource<3>> narrow;
  collective_try(*level.comm, [&] {
    narrow = resolving_sources(level.geometry.spacing(), level.geometry.domain(),
                               level.settings.node_limit(), kApart);
    if (near.empty()) return;
    const Surroundings surroundings(near);
    std::erase_if(narrow,
                  [&](const GrowthSource<3>& source) { return !surroundings.hold(source.x); });
  });
  return narrow;
}

}  // namespace pnpbs
