// SPDX-License-Identifier: BSD-3-Clause
#include "stars/delaunay_stars.hpp"

#include <algorithm>
#include <limits>

#include "stars/constrained_star.hpp"
#include "stars/hull_star.hpp"

namespace pnpbs {

namespace {

double least_spacing_around(const Buckets<2>& buckets, std::int32_t bucket) {
  double least = std::numeric_limits<double>::infinity();
  buckets.for_neighbours(
      bucket, [&](std::int32_t b) { least = std::min(least, buckets.least_spacing(b)); });
  return least;
}

// Finds the stars of consecutive nodes.
class StarWriter {
 public:
  StarWriter(const StarInput& input, std::vector<double>& needs) : in_(input), needs_(needs) {}

  void operator()(std::int64_t i, std::vector<DelaunayStars::Entry>& out) {
    const Nodes<2>& nodes = in_.nodes;
    if (in_.buckets.bucket_of(i) != bucket_) look_at_bucket(in_.buckets.bucket_of(i));
    // The lists hold every node nearer than this, if it is known.
    const double reach = 0.5 * in_.lists.radius() * (nodes.d(i) + least_);
    const bool listed = !rim_ || in_.known.covers(in_.map, box_around<2>(nodes.position(i), reach));
    if (listed && !in_.near_edges.any(i) && add_hull_star(i, reach, out)) return;
    const double needs = constrained_star(in_, i, std::max(reach, nodes.d(i)), out);
    if (!needs_.empty()) needs_[static_cast<std::size_t>(i)] = needs;
  }

 private:
  void look_at_bucket(std::int32_t bucket) {
    bucket_ = bucket;
    least_ = least_spacing_around(in_.buckets, bucket);
    double largest = 0;
    for (std::int32_t i = in_.buckets.begin(bucket); i < in_.buckets.end(bucket); ++i)
      largest = std::max(largest, in_.nodes.d(i));
    const double reach = in_.lists.radius() * largest;
    Box<2> around = in_.map.tree().cell_box(in_.map.tree().leaf_cell(bucket));
    for (int k = 0; k < 2; ++k) {
      around.low[k] -= reach;
      around.high[k] += reach;
    }
    rim_ = !in_.known.covers(in_.map, around);
  }

  StarPoint point(std::int64_t j) const {
    return {in_.nodes.position(j), in_.nodes.id(j), static_cast<std::int32_t>(j)};
  }

  bool add_hull_star(std::int64_t i, double reach, std::vector<DelaunayStars::Entry>& out) {
    around_.clear();
    in_.lists.for_neighbours(i, [&](std::int64_t j) { around_.push_back(point(j)); });
    if (!hull_star(point(i), reach, around_)) return false;
    for (const StarPoint& p : around_) out.push_back({static_cast<std::uint32_t>(p.node), 1});
    return true;
  }

  const StarInput& in_;
  std::vector<double>& needs_;
  std::vector<StarPoint> around_;
  std::int32_t bucket_ = -1;
  double least_ = 0;  // spacing in the buckets around
  bool rim_ = false;  // do the lists of some nodes in the bucket reach into the unknown?
};

}  // namespace

void DelaunayStars::build(const StarInput& input) {
  needs_.assign(input.known.is_everywhere() ? 0 : static_cast<std::size_t>(input.nodes.count), 0);
  stars_.build("pnpbs::DelaunayStars::build", input.nodes.count,
               [&] { return StarWriter(input, needs_); });
}

}  // namespace pnpbs
