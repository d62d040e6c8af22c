// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/near_edges.hpp"

#include <algorithm>

#include "geometry/segments.hpp"

namespace pnpbs {

void NearEdges::prepare(const DomainMap& map, double radius) {
  radius_ = radius;
  const std::int32_t leaves = map.tree().leaf_count();
  leaf_reach_.assign(static_cast<std::size_t>(leaves), 0);
  leaf_offset_.assign(1, 0);
  leaf_edges_.clear();
  std::vector<std::int32_t> near;
  for (std::int32_t leaf = 0; leaf < leaves; ++leaf) {
    near.clear();
    const std::int32_t cell = map.tree().leaf_cell(leaf);
    const double reach = kRoomForGrowth * radius * map.leaf_largest_spacing(leaf);
    leaf_reach_[static_cast<std::size_t>(leaf)] = reach;
    const double half_diagonal = 0.7072 * map.tree().cell_side(cell);
    map.for_edges_near(map.tree().cell_centre(cell), half_diagonal + reach,
                       [&](std::int32_t e) { near.push_back(e); });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    leaf_edges_.insert(leaf_edges_.end(), near.begin(), near.end());
    leaf_offset_.push_back(static_cast<std::int32_t>(leaf_edges_.size()));
  }
}

void NearEdges::build(const Nodes<2>& nodes, const std::array<View<double>, 2>& at,
                      const Buckets<2>& buckets, const DomainMap& map) {
  at_ = at;
  if (static_cast<std::int64_t>(any_.extent(0)) < nodes.capacity())
    any_ = make_view<char>("pnpbs::NearEdges::any", nodes.capacity());
  const auto write = [&](std::int64_t i, std::vector<std::int32_t>& out) {
    const std::size_t before = out.size();
    const double reach = radius_ * nodes.d(i);
    const Point<2> x{at[0](i), at[1](i)};
    const std::int32_t bucket = buckets.bucket_of(i);
    const std::size_t leaf =
        static_cast<std::size_t>(map.tree().leaf_holds(bucket, x) ? bucket : map.tree().leaf_at(x));
    const auto keep_if_near = [&](std::int32_t e) {
      if (distance_to_segment(map.edge_begin(e), map.edge_end(e), x) <= reach) out.push_back(e);
    };
    if (reach <= leaf_reach_[leaf]) {
      for (std::int32_t e = leaf_offset_[leaf]; e < leaf_offset_[leaf + 1]; ++e)
        keep_if_near(leaf_edges_[static_cast<std::size_t>(e)]);
    } else {
      map.for_edges_near(x, reach, keep_if_near);
    }
    any_(i) = out.size() > before;
  };
  edges_.build("pnpbs::NearEdges::build", nodes.count, [&] { return write; });
}

bool NearEdges::way_between_is_free(const Nodes<2>& nodes, const DomainMap& map,
                                    const BoundaryFans& fans, std::int64_t i, std::int64_t j,
                                    std::int64_t wide) const {
  const Point<2> x{at_[0](i), at_[1](i)}, y{at_[0](j), at_[1](j)};
  return way_is_free(map, fans, x, nodes.boundary_node(i), y, nodes.boundary_node(j),
                     edges_of(wide));
}

}  // namespace pnpbs
