// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/growth_limit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "base/execution.hpp"

namespace pnpbs {

GrowthLimitedSpacing::GrowthLimitedSpacing(const PlaneDomain& domain,
                                           std::shared_ptr<const Spacing<2>> raw, double growth,
                                           const NodeLimit& limit, const Beat& beat)
    : raw_(std::move(raw)), growth_(growth) {
  const SpacingEvaluator<2> checked = [&](std::int64_t n, const Point<2>* x, double* d) {
    beat();
    evaluate_spacing<2>(*raw_, domain.area(), n, x, d);
  };
  boundary_ = discretize_boundary(domain, checked, limit.max_nodes);
  map_.build(domain.bounds(), boundary_, checked, limit, growth);
  look_at_new_tree(samples_of_leaves(domain.area()), beat);
  fit_tree(domain, limit, beat);
}

void GrowthLimitedSpacing::look_at_new_tree(const std::vector<Source>& sources, const Beat& beat) {
  link_leaves();
  at_centre_.assign(static_cast<std::size_t>(map_.tree().leaf_count()),
                    std::numeric_limits<double>::infinity());
  source_.assign(at_centre_.size(), {{}, std::numeric_limits<double>::infinity()});
  for (const Source& source : sources) offer(map_.tree().leaf_at(source.x), source);
  relax(beat);
}

// The tree so far has leaves as large as the unlimited d allows, and one source stands for all of a
// leaf: next to a jump that is too coarse, and what is fine in a corner of a leaf was not sampled.
// With leaves by the limited d it is not.
void GrowthLimitedSpacing::fit_tree(const PlaneDomain& domain, const NodeLimit& limit,
                                    const Beat& beat) {
  constexpr int kMostPasses = 6;
  const SpacingEvaluator<2> limited = [&](std::int64_t n, const Point<2>* x, double* d) {
    beat();
    evaluate_spacing<2>(*this, domain.area(), n, x, d);
  };
  for (int pass = 0; pass < kMostPasses; ++pass) {
    const std::int32_t leaves = map_.tree().leaf_count();
    DomainMap<2> fitted;
    fitted.build(domain.bounds(), boundary_, limited, limit, 0, &map_.tree());
    std::vector<Source> sources = std::move(source_);
    std::erase_if(sources, [](const Source& source) { return std::isinf(source.d); });
    map_ = std::move(fitted);
    const std::vector<Source> seen_now = samples_of_leaves(domain.area());
    sources.insert(sources.end(), seen_now.begin(), seen_now.end());
    look_at_new_tree(sources, beat);
    if (map_.tree().leaf_count() == leaves) break;
  }
}

void GrowthLimitedSpacing::link_leaves() {
  const BackgroundTree<2>& tree = map_.tree();
  next_to_.clear();
  offset_.assign(1, 0);
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    if (!map_.leaf_outside(leaf)) {
      Box<2> box = tree.cell_box(tree.leaf_cell(leaf));
      const double rim = 1e-6 * tree.cell_side(tree.leaf_cell(leaf));
      for (int k = 0; k < 2; ++k) {
        box.low[k] -= rim;
        box.high[k] += rim;
      }
      tree.for_leaves_in(box, [&](std::int32_t other) {
        if (other != leaf && !map_.leaf_outside(other)) next_to_.push_back(other);
      });
    }
    offset_.push_back(static_cast<std::int32_t>(next_to_.size()));
  }
}

// d as given, in the leaves and at the boundary nodes.
std::vector<GrowthLimitedSpacing::Source> GrowthLimitedSpacing::samples_of_leaves(
    double measure) const {
  const BackgroundTree<2>& tree = map_.tree();
  std::vector<Point<2>> points;
  const double quarters[5][2] = {
      {0.5, 0.5}, {0.25, 0.25}, {0.75, 0.25}, {0.25, 0.75}, {0.75, 0.75}};
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    if (map_.leaf_outside(leaf)) continue;
    const Box<2> box = tree.cell_box(tree.leaf_cell(leaf));
    const double side = tree.cell_side(tree.leaf_cell(leaf));
    for (const auto& quarter : quarters) {
      const Point<2> x{box.low[0] + quarter[0] * side, box.low[1] + quarter[1] * side};
      if (map_.inside_in_leaf(leaf, x)) points.push_back(x);
    }
  }
  for (const BoundaryNode<2>& node : boundary_.nodes) points.push_back(node.position);
  std::vector<double> d(points.size());
  evaluate_spacing<2>(*raw_, measure, std::ssize(points), points.data(), d.data());
  std::vector<Source> samples;
  for (std::size_t s = 0; s < points.size(); ++s) samples.push_back({points[s], d[s]});
  return samples;
}

double GrowthLimitedSpacing::limit_by(const Source& source, const Point<2>& x) const {
  return source.d + growth_ * distance<2>(source.x, x);
}

bool GrowthLimitedSpacing::allows_less(const Source& source, std::int32_t leaf) const {
  return limit_by(source, centre(leaf)) < at_centre_[static_cast<std::size_t>(leaf)];
}

// Takes a source for a leaf if it allows less in its middle than the one there; returns whether.
bool GrowthLimitedSpacing::offer(std::int32_t leaf, const Source& source) {
  if (!allows_less(source, leaf)) return false;
  at_centre_[static_cast<std::size_t>(leaf)] = limit_by(source, centre(leaf));
  source_[static_cast<std::size_t>(leaf)] = source;
  return true;
}

// Does the straight way from a to b run through leaves wholly inside the domain, but for its ends?
bool GrowthLimitedSpacing::open_way(const Point<2>& a, const Point<2>& b) const {
  const BackgroundTree<2>& tree = map_.tree();
  const std::int32_t first = tree.leaf_at(a), last = tree.leaf_at(b);
  const double length = distance<2>(a, b);
  for (double way = 0; way < length;) {
    const double t = way / length;
    const std::int32_t leaf = tree.leaf_at({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
    const bool end = leaf == first || leaf == last;
    if (!end && (map_.leaf_outside(leaf) || map_.leaf_has_facets(leaf))) return false;
    way += 0.5 * tree.cell_side(tree.leaf_cell(leaf));
  }
  return true;
}

// From leaf to touching leaf, least values first (Dijkstra). In the open a leaf hands on the sample
// that limits it, so that the limit grows with the straight distance from there; around corners it
// hands on its own middle.
void GrowthLimitedSpacing::relax(const Beat& beat) {
  constexpr std::int64_t kBetweenBeats = 4096;
  using Entry = std::pair<double, std::int32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::int32_t leaf = 0; leaf < map_.tree().leaf_count(); ++leaf)
    if (at_centre_[static_cast<std::size_t>(leaf)] < std::numeric_limits<double>::infinity())
      queue.emplace(at_centre_[static_cast<std::size_t>(leaf)], leaf);
  for (std::int64_t n = 0; !queue.empty(); ++n) {
    if (n % kBetweenBeats == 0) beat();
    const auto [value, leaf] = queue.top();
    queue.pop();
    if (value > at_centre_[static_cast<std::size_t>(leaf)]) continue;
    const Source source = source_[static_cast<std::size_t>(leaf)];
    const Source middle{centre(leaf), value};
    for (std::int32_t k = offset_[static_cast<std::size_t>(leaf)];
         k < offset_[static_cast<std::size_t>(leaf) + 1]; ++k) {
      const std::int32_t other = next_to_[static_cast<std::size_t>(k)];
      if (!allows_less(source, other)) continue;  // its middle does not either, by a longer way
      if (offer(other, open_way(source.x, centre(other)) ? source : middle))
        queue.emplace(at_centre_[static_cast<std::size_t>(other)], other);
    }
  }
}

// By the source of its leaf, and by those of touching ones where no boundary is between.
double GrowthLimitedSpacing::limit_at(const Point<2>& x) const {
  const std::int32_t leaf = map_.tree().leaf_at(x);
  double limit = limit_by(source_[static_cast<std::size_t>(leaf)], x);
  for (std::int32_t k = offset_[static_cast<std::size_t>(leaf)];
       k < offset_[static_cast<std::size_t>(leaf) + 1]; ++k) {
    const std::int32_t other = next_to_[static_cast<std::size_t>(k)];
    const Source& source = source_[static_cast<std::size_t>(other)];
    const double by_other = limit_by(source, x);
    if (by_other < limit && !map_.facet_between(leaf, x, source.x) &&
        !map_.facet_between(other, x, source.x))
      limit = by_other;
  }
  return limit;
}

void GrowthLimitedSpacing::evaluate(std::int64_t n, const Point<2>* x, double* d) const {
  raw_->evaluate(n, x, d);
  for_each("pnpbs::GrowthLimitedSpacing::evaluate", n, [=, this](std::int64_t i) {
    // Written so that bad values (not a number) stay and are reported.
    const double limit = limit_at(x[i]);
    if (d[i] > limit) d[i] = limit;
  });
}

}  // namespace pnpbs
