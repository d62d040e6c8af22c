// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/plane/constrained_star.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include "delaunay/plane/hull_star.hpp"
#include "predicates/plane.hpp"
#include "sphere/sphere_cap.hpp"

namespace pnpbs {

namespace {

using Entry = DelaunayStars::Entry;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

class GiftWrap {
 public:
  // Uses the list of node i, which contains all nodes visible from it within `reach`.
  GiftWrap(const StarInput& input, std::int64_t i, double reach)
      : GiftWrap(input, i, reach, false, {}) {
    gather_listed();
  }

  // Uses all nodes within `reach`. `everything` says whether these are all nodes.
  GiftWrap(const StarInput& input, std::int64_t i, double reach, bool everything)
      : GiftWrap(input, i, reach, everything, {}) {
    gather_all();
  }

  // Uses all nodes of a cap of the sphere around node i.
  GiftWrap(const StarInput& input, std::int64_t i, const SphereCap& cap)
      : GiftWrap(input, i, kInfinity, cap.is_whole_sphere(), {}) {
    cap_ = cap;
    gather_cap();
  }

  // Returns whether the reach is probably too small: there are many boundary nodes, no inner one,
  // and none whose circle with an edge of this node lies within reach. The relevant nodes are then
  // most likely farther away, and wrapping would take long to find that out.
  bool reach_seems_too_short() const {
    constexpr std::size_t kMany = 64;
    if (inner_ > 0 || around_.size() <= kMany || everything_ || boundary_ < 0) return false;
    const std::int32_t edge = in_.sectors.begin(boundary_);
    if (edge == in_.sectors.end(boundary_)) return false;
    const auto other = static_cast<std::size_t>(in_.sectors.edge(edge).other);
    const Point<2>& a = in_.map.boundary().nodes[other].position;
    return std::none_of(around_.begin(), around_.end(), [&](const StarPoint& p) {
      return circle_diameter(centre_.position, a, p.position) <= reach_;
    });
  }

  // Appends the star. Returns false if nodes beyond the reach may change it.
  bool wrap(std::vector<Entry>& star) {
    if (!listed_ && !cap_) find_edges();
    if (boundary_ >= 0 && in_.sectors.begin(boundary_) != in_.sectors.end(boundary_))
      return wrap_sectors(star);
    const int first = nearest_visible();
    if (first < 0) return false;
    return wrap_from(first, around_[index(first)].node, star);
  }

 private:
  struct Nothing {};
  GiftWrap(const StarInput& input, std::int64_t i, double reach, bool everything, Nothing)
      : in_(input),
        centre_(node(i)),
        boundary_(input.nodes.boundary_node(i)),
        reach_(reach),
        everything_(everything) {}

  static std::size_t index(int k) { return static_cast<std::size_t>(k); }

  StarPoint node(std::int64_t j) const {
    return {in_.nodes.position(j), in_.nodes.id(j), static_cast<std::int32_t>(j)};
  }

  // Edges between any two listed nodes lie within reach as well, so near_edges contains them.
  void gather_listed() {
    around_.reserve(16);
    in_.lists.for_neighbours(centre_.node, [&](std::int64_t j) {
      const double gap = squared_distance<2>(centre_.position, in_.nodes.position(j));
      if (gap > 0 && gap <= reach_ * reach_) around_.push_back(node(j));
    });
    put_inner_first();
    listed_ = true;
    edges_ = in_.near_edges.edges_of(centre_.node);
    sees_centre_.assign(around_.size(), 1);
  }

  void gather_all() {
    const Point<2>& x = centre_.position;
    in_.map.tree().for_leaves_in(box_around<2>(x, reach_), [&](std::int32_t leaf) {
      for (std::int32_t j = in_.buckets.begin(leaf); j < in_.buckets.end(leaf); ++j) {
        const double gap = squared_distance<2>(x, in_.nodes.position(j));
        if (j != centre_.node && gap > 0 && gap <= reach_ * reach_) around_.push_back(node(j));
      }
    });
    put_inner_first();
    sees_centre_.assign(around_.size(), -1);
  }

  // The cap can surround a hole of the chart. Edges in the hole that separate two nodes are not
  // found, so that too many pairs count as visible. This does not produce wrong triangles: the
  // segments between the corners of a proven triangle lie inside its circle, which the cap contains
  // completely.
  void gather_cap() {
    const BackgroundTree<2>& tree = in_.map.tree();
    const auto meets_cap = [&](std::int32_t cell) {
      return cap_->meets(tree.cell_box_with_room(cell));
    };
    tree.for_leaves_in(tree.cell_box(0), meets_cap, [&](std::int32_t leaf) {
      for (std::int32_t j = in_.buckets.begin(leaf); j < in_.buckets.end(leaf); ++j) {
        const Point<2> x = in_.nodes.position(j);
        if (x != centre_.position && cap_->holds(x)) around_.push_back(node(j));
      }
      const auto facets = in_.map.facets_of_leaf(leaf);
      found_edges_.insert(found_edges_.end(), facets.begin(), facets.end());
    });
    put_inner_first();
    sees_centre_.assign(around_.size(), -1);
    keep_found_edges();
  }

  void find_edges() {
    in_.map.for_facets_near(centre_.position, reach_,
                            [&](std::int32_t e) { found_edges_.push_back(e); });
    keep_found_edges();
  }

  void keep_found_edges() {
    std::sort(found_edges_.begin(), found_edges_.end());
    found_edges_.erase(std::unique(found_edges_.begin(), found_edges_.end()), found_edges_.end());
    edges_ = found_edges_;
  }

  // The result does not depend on the order, but the time does. If the boundary is much finer than
  // d, the circle through an inner node and an edge excludes hundreds of boundary nodes at once.
  // Boundary nodes alone often lie on one circle, which requires exact arithmetic.
  void put_inner_first() {
    const auto first_of_boundary =
        std::partition(around_.begin(), around_.end(),
                       [&](const StarPoint& p) { return in_.nodes.boundary_node(p.node) < 0; });
    inner_ = static_cast<std::size_t>(first_of_boundary - around_.begin());
  }

  bool visible(const StarPoint& a, const StarPoint& b) const {
    return visible_between(in_.map, in_.sectors, a.position, in_.nodes.boundary_node(a.node),
                           b.position, in_.nodes.boundary_node(b.node), edges_);
  }

  bool sees_centre(int k) {
    signed char& known = sees_centre_[index(k)];
    if (known < 0) known = visible(centre_, around_[index(k)]);
    return known != 0;
  }

  bool is_edge(const StarPoint& a, const StarPoint& b) const {
    const std::int32_t p = in_.nodes.boundary_node(a.node), q = in_.nodes.boundary_node(b.node);
    return p >= 0 && q >= 0 && in_.sectors.joined(p, q);
  }

  int nearest_visible() {
    int nearest = -1;
    double min = kInfinity;
    for (int k = 0; k < static_cast<int>(around_.size()); ++k) {
      const double gap = squared_distance<2>(centre_.position, around_[index(k)].position);
      const bool nearer =
          gap < min || (gap == min && around_[index(k)].id < around_[index(nearest)].id);
      if (!nearer || !sees_centre(k)) continue;
      min = gap;
      nearest = k;
    }
    return nearest;
  }

  // Returns a neighbour counter-clockwise of a that a boundary edge connects to a or the centre, or
  // -1. It usually is the neighbour that follows, and excludes the others at once.
  int joined_after(const StarPoint& a) {
    for (std::size_t k = inner_; k < around_.size(); ++k) {
      const StarPoint& p = around_[k];
      if (!is_edge(a, p) && !is_edge(centre_, p)) continue;
      if (orientation(centre_.position, a.position, p.position) <= 0) continue;
      if (sees_centre(static_cast<int>(k)) && visible(a, p)) return static_cast<int>(k);
    }
    return -1;
  }

  // Returns the neighbour that follows a counter-clockwise, or -1.
  int next_after(const StarPoint& a) {
    int best = joined_after(a);
    for (int k = 0; k < static_cast<int>(around_.size()); ++k) {
      const StarPoint& p = around_[index(k)];
      if (p.node == a.node) continue;
      if (orientation(centre_.position, a.position, p.position) <= 0) continue;
      if (best >= 0) {
        const StarPoint& b = around_[index(best)];
        if (in_circle_perturbed(centre_.position, a.position, b.position, p.position, centre_.id,
                                a.id, b.id, p.id) <= 0)
          continue;
      }
      if (sees_centre(k) && visible(a, p)) best = k;
    }
    return best;
  }

  // Returns whether all nodes that could invalidate the triangle are in around_.
  bool is_proven(const StarPoint& a, const StarPoint& b) const {
    if (everything_) return true;
    if (cap_) return cap_->holds_circle(a.position, b.position);
    return needed_reach(centre_.position, a.position, b.position,
                        {is_edge(centre_, a), is_edge(centre_, b), is_edge(a, b)}) <= reach_;
  }

  // Wraps from neighbour `first` to node `last`, and appends all but the last.
  bool wrap_from(int first, std::int32_t last, std::vector<Entry>& star) {
    StarPoint a = around_[index(first)];
    for (std::size_t guard = 0; guard <= around_.size(); ++guard) {
      const int k = next_after(a);
      if (k < 0) return false;
      const StarPoint b = around_[index(k)];
      if (!is_proven(a, b)) return false;
      star.push_back({a.node, true});
      if (b.node == last) return true;
      a = b;
    }
    return false;
  }

  int find_boundary_node(std::int32_t boundary_node) const {
    for (int k = 0; k < static_cast<int>(around_.size()); ++k)
      if (in_.nodes.boundary_node(around_[index(k)].node) == boundary_node) return k;
    return -1;
  }

  // Wraps around a boundary node, in each sector from one boundary edge to the next.
  bool wrap_sectors(std::vector<Entry>& star) {
    const std::int32_t begin = in_.sectors.begin(boundary_), end = in_.sectors.end(boundary_);
    for (std::int32_t s = begin; s < end; ++s) {
      const SectorEdge& from = in_.sectors.edge(s);
      const SectorEdge& to = in_.sectors.edge(s + 1 < end ? s + 1 : begin);
      const int first = find_boundary_node(from.other), last = find_boundary_node(to.other);
      if (first < 0 || last < 0) return false;
      if (!from.inside_after) {
        star.push_back({around_[index(first)].node, false});
        continue;
      }
      if (!wrap_from(first, around_[index(last)].node, star)) return false;
    }
    return true;
  }

  const StarInput& in_;
  StarPoint centre_;
  std::int32_t boundary_;
  double reach_;
  bool everything_;               // Whether all nodes are within reach.
  bool listed_ = false;           // Whether around_ is from the list.
  std::optional<SphereCap> cap_;  // Cap that around_ is from, if any.
  std::vector<StarPoint> around_;
  std::size_t inner_ = 0;                // Number of inner nodes, which come first.
  std::span<const std::int32_t> edges_;  // All edges that can separate two of the nodes.
  std::vector<std::int32_t> found_edges_;
  std::vector<signed char> sees_centre_;  // -1 if not evaluated yet.
};

// Marks a gap after the last neighbour. This is the star if all nodes have been searched, which
// requires fewer than three nodes in all.
void leave_gap(std::vector<Entry>& star, std::size_t before) {
  if (star.size() > before) star.back() = {star.back().value(), false};
}

// Finds a star in the patch of a whole sphere. Bubbles there grow in the chart towards the
// projection centre, and nodes that are near along the sphere are as far away in the chart as all
// others. No list contains all nodes within such a chart length, and a search of it would visit all
// nodes. Circles of the chart are circles of the sphere, so the caps result in the same star as a
// search of all nodes.
double star_in_patch(const StarInput& input, std::int64_t i, std::vector<Entry>& star) {
  constexpr double kFirst = 2, kNext = 1.5;  // Circles of a lattice have a diameter of 1.15 d.
  const std::size_t before = star.size();
  const StereographicChart& chart = input.domain.embedding().chart();
  const Point<2> at = input.nodes.position(i);
  for (double length = kFirst * input.nodes.d(i) / chart.stretch(at);; length *= kNext) {
    const SphereCap cap(chart, at, length);
    bool known = true;
    const BackgroundTree<2>& tree = input.map.tree();
    input.known.for_unknown_leaves(
        tree, [&](std::int32_t cell) { return cap.meets(tree.cell_box_with_room(cell)); },
        [&](std::int32_t) { known = false; });
    star.resize(before);
    if (!known) return length;
    if (GiftWrap(input, i, cap).wrap(star)) return 0;
    if (cap.is_whole_sphere()) break;
  }
  leave_gap(star, before);
  return 0;
}

}  // namespace

double constrained_star(const StarInput& input, std::int64_t i, double listed_reach,
                        double first_reach, std::vector<Entry>& star) {
  if (input.domain.is_in_patch(input.nodes.position(i))) return star_in_patch(input, i, star);
  const std::size_t before = star.size();
  // Stops reach_seems_too_short(), because a channel may contain boundary nodes only.
  constexpr double kFar = 16;
  const auto found = [&](GiftWrap&& wrap, double reach) {
    return (reach > kFar * first_reach || !wrap.reach_seems_too_short()) && wrap.wrap(star);
  };
  if (listed_reach > 0 && found(GiftWrap(input, i, listed_reach), listed_reach)) return 0;
  for (double reach = first_reach;; reach *= 1.5) {
    star.resize(before);
    if (!input.known.covers(input.map.tree(), box_around<2>(input.nodes.position(i), reach)))
      return reach;
    const bool everything = reach > 2 * input.map.tree().side();
    if (found(GiftWrap(input, i, reach, everything), reach)) return 0;
    if (everything) break;
  }
  leave_gap(star, before);
  return 0;
}

}  // namespace pnpbs
