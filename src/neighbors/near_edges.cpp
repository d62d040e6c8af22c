// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/near_edges.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "geometry/plane/segments.hpp"
#include "tree/hop_search.hpp"

namespace pnpbs {

void NearEdges::prepare(const SizedTree<2>& map, const LeafGraph<2>& links, double radius) {
  radius_ = radius;
  at_boundary_nodes_.assign(map.boundary().nodes.size(), {});
  const std::int32_t leaves = map.tree().leaf_count();
  leaf_reach_.assign(static_cast<std::size_t>(leaves), 0);
  leaf_offset_.assign(1, 0);
  leaf_edges_.clear();
  for (int k = 0; k < 2; ++k) {
    low_[k].clear();
    high_[k].clear();
  }
  std::vector<std::int32_t> near, with_edges;
  for (std::int32_t leaf = 0; leaf < leaves; ++leaf)
    if (map.leaf_has_facets(leaf)) with_edges.push_back(leaf);
  const std::vector<std::int32_t> to_edges = hops_from(links, with_edges, 1);
  for (std::int32_t leaf = 0; leaf < leaves; ++leaf) {
    const double reach = kRoomForGrowth * radius * map.leaf_max_spacing(leaf);
    leaf_reach_[static_cast<std::size_t>(leaf)] = reach;
    near.clear();
    if (reach > links.reach(leaf) || to_edges[static_cast<std::size_t>(leaf)] <= 1)
      gather_near(map, links, leaf, near);
    leaf_edges_.insert(leaf_edges_.end(), near.begin(), near.end());
    for (std::int32_t e : near) add_box(map.corners(e)[0], map.corners(e)[1], reach);
    leaf_offset_.push_back(static_cast<std::int32_t>(leaf_edges_.size()));
  }
}

// Appends all edges within the search radius of a leaf, and possibly more, sorted by number.
void NearEdges::gather_near(const SizedTree<2>& map, const LeafGraph<2>& links, std::int32_t leaf,
                            std::vector<std::int32_t>& near) const {
  const double reach = leaf_reach_[static_cast<std::size_t>(leaf)];
  if (reach <= links.reach(leaf)) {
    links.search_neighbours(
        leaf, [](std::int32_t) { return true; },
        [&](std::int32_t other) {
          for (const std::int32_t e : map.facets_of_leaf(other)) near.push_back(e);
        });
  } else {
    const std::int32_t cell = map.tree().leaf_cell(leaf);
    const double half_diagonal = 0.7072 * map.tree().cell_side(cell);
    map.for_facets_near(map.tree().cell_centre(cell), half_diagonal + reach,
                        [&](std::int32_t e) { near.push_back(e); });
  }
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
}

// Stores the box of an edge, enlarged by the rounding error of a distance from the edge.
void NearEdges::add_box(const Point<2>& a, const Point<2>& b, double reach) {
  constexpr double kRounding = 1e-12;  // thousands of times the error of one operation
  for (int k = 0; k < 2; ++k) {
    const double room = kRounding * (std::fabs(a[k]) + std::fabs(b[k]) + reach);
    low_[k].push_back(std::min(a[k], b[k]) - room);
    high_[k].push_back(std::max(a[k], b[k]) + room);
  }
}

// Writes the edges near consecutive nodes.
class NearEdges::Finder {
 public:
  Finder(NearEdges& edges, const Nodes<2>& nodes, const Buckets<2>& buckets,
         const SizedTree<2>& map)
      : of_(edges), nodes_(nodes), buckets_(buckets), map_(map) {}

  void operator()(std::int64_t i, std::vector<std::int32_t>& out) {
    if (buckets_.bucket_of(i) != bucket_) look_at_bucket(buckets_.bucket_of(i));
    if (nothing_near_) {
      of_.any_(i) = 0;
      of_.gap_(i) = of_.radius_ * nodes_.d(i);
      return;
    }
    const std::size_t before = out.size();
    of_.gap_(i) = nodes_.boundary_node(i) < 0 ? find(i, out) : find_once(i, out);
    of_.any_(i) = out.size() > before;
  }

 private:
  // Detects buckets without near edges, which are the majority. All their nodes must have been in
  // the leaf in `at_`.
  void look_at_bucket(std::int32_t bucket) {
    bucket_ = bucket;
    box_ = map_.tree().fine_box(bucket);
    const double reach = of_.leaf_reach_[static_cast<std::size_t>(bucket)];
    nothing_near_ = of_.leaf_is_clear(bucket);
    for (std::int64_t i = buckets_.begin(bucket); nothing_near_ && i < buckets_.end(bucket); ++i)
      nothing_near_ =
          map_.tree().fine_box_holds(box_, of_.place_of(i)) && of_.radius_ * nodes_.d(i) <= reach;
  }

  // Returns the stored result for boundary nodes, which are searched once for each d.
  double find_once(std::int64_t i, std::vector<std::int32_t>& out) {
    const std::int32_t b = nodes_.boundary_node(i);
    Found& found = of_.at_boundary_nodes_[static_cast<std::size_t>(b)];
    const double reach = of_.radius_ * nodes_.d(i);
    if (found.reach != reach) {
      found.reach = 0;
      found.edges.clear();
      found.nearest = find(i, found.edges);
      found.beyond = reach;
      for (std::int32_t e : found.edges)
        found.beyond = std::min(found.beyond, distance_beyond(b, e, of_.place_of(i)));
      found.reach = reach;
    }
    out.insert(out.end(), found.edges.begin(), found.edges.end());
    return found.nearest;
  }

  // Returns the distance of boundary node b at x from an edge, or from the far end of an edge of
  // its own.
  double distance_beyond(std::int32_t b, std::int32_t e, const Point<2>& x) const {
    const BoundaryEdge& edge = map_.facet(e);
    const bool begins = edge.begin == b, ends = edge.end == b;
    if (begins && ends) return kFarAway;  // the edge of a fixed node
    if (begins) return distance<2>(x, map_.corners(e)[1]);
    if (ends) return distance<2>(x, map_.corners(e)[0]);
    return distance_to_segment(map_.corners(e)[0], map_.corners(e)[1], x);
  }

  // Appends the edges within reach of node i. Returns the distance to the nearest one, or the reach
  // if none exists.
  double find(std::int64_t i, std::vector<std::int32_t>& out) {
    const double reach = of_.radius_ * nodes_.d(i);
    const Point<2> x = of_.place_of(i);
    const std::int32_t leaf =
        map_.tree().fine_box_holds(box_, x) ? bucket_ : map_.tree().leaf_at(x);
    double nearest = reach;
    const auto keep_if_near = [&](std::int32_t e) {
      const double gap = distance_to_segment(map_.corners(e)[0], map_.corners(e)[1], x);
      if (gap > reach) return;
      out.push_back(e);
      nearest = std::min(nearest, gap);
    };
    if (reach <= of_.leaf_reach_[static_cast<std::size_t>(leaf)])
      for_boxes_near(leaf, x, reach, keep_if_near);
    else
      map_.for_facets_near(x, reach, keep_if_near);
    return nearest;
  }

  // Calls visit(edge) for the edges of the leaf whose boxes are within reach of x.
  template <class Visit>
  void for_boxes_near(std::int32_t leaf, const Point<2>& x, double reach,
                      const Visit& visit) const {
    constexpr std::int32_t kWord = 64;
    const std::int32_t end = of_.leaf_offset_[static_cast<std::size_t>(leaf) + 1];
    for (std::int32_t e = of_.leaf_offset_[static_cast<std::size_t>(leaf)]; e < end; e += kWord)
      for (std::uint64_t bits = boxes_near(e, std::min(kWord, end - e), x, reach); bits != 0;
           bits &= bits - 1)
        visit(of_.leaf_edges_[static_cast<std::size_t>(e + std::countr_zero(bits))]);
  }

  // Returns a bit for each of n boxes: 1 if it is within reach of x.
  std::uint64_t boxes_near(std::int32_t first, std::int32_t n, const Point<2>& x,
                           double reach) const {
    constexpr double kRoom = 1 + 1e-12;  // bounds the rounding error
    const double limit = kRoom * reach * reach;
    const double *const low_x = of_.low_[0].data() + first,
                        *const low_y = of_.low_[1].data() + first,
                        *const high_x = of_.high_[0].data() + first,
                        *const high_y = of_.high_[1].data() + first;
    std::uint64_t bits = 0;
#pragma omp simd reduction(| : bits)
    for (std::uint64_t c = 0; c < static_cast<std::uint64_t>(n); ++c) {
      const double gap_x = x[0] - std::min(std::max(x[0], low_x[c]), high_x[c]);
      const double gap_y = x[1] - std::min(std::max(x[1], low_y[c]), high_y[c]);
      bits |= static_cast<std::uint64_t>(gap_x * gap_x + gap_y * gap_y <= limit) << c;
    }
    return bits;
  }

  NearEdges& of_;
  const Nodes<2>& nodes_;
  const Buckets<2>& buckets_;
  const SizedTree<2>& map_;
  std::int32_t bucket_ = -1;
  Box<2> box_{};               // fine box of the bucket
  bool nothing_near_ = false;  // true if no node of the bucket has edges near it
};

void NearEdges::build(const Nodes<2>& nodes, const Field<2>& at, const Buckets<2>& buckets,
                      const SizedTree<2>& map) {
  at_ = at;
  if (static_cast<std::int64_t>(any_.extent(0)) < nodes.capacity()) {
    any_ = make_view<char>("pnpbs::NearEdges::any", nodes.capacity());
    gap_ = make_view<double>("pnpbs::NearEdges::gap", nodes.capacity());
  }
  edges_.build("pnpbs::NearEdges::build", nodes.count,
               [&] { return Finder(*this, nodes, buckets, map); });
}

bool NearEdges::visible_past_edges(const Nodes<2>& nodes, const SizedTree<2>& map,
                                   const IncidentSectors& sectors, std::int64_t i, std::int64_t j,
                                   std::int64_t wide) const {
  return visible_between(map, sectors, place_of(i), nodes.boundary_node(i), place_of(j),
                         nodes.boundary_node(j), edges_of(wide));
}

}  // namespace pnpbs
