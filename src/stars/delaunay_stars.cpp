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
  explicit StarWriter(const StarInput& input) : in_(input) {}

  void operator()(std::int64_t i, std::vector<DelaunayStars::Entry>& out) {
    const Nodes<2>& nodes = in_.nodes;
    if (!in_.wanted.empty() && !in_.wanted[static_cast<std::size_t>(in_.buckets.bucket_of(i))])
      return;
    if (in_.buckets.bucket_of(i) != bucket_) {
      bucket_ = in_.buckets.bucket_of(i);
      least_ = least_spacing_around(in_.buckets, bucket_);
    }
    // The lists hold every node nearer than this.
    const double reach = 0.5 * in_.lists.radius() * (nodes.d(i) + least_);
    if (!in_.near_edges.any(i) && add_hull_star(i, reach, out)) return;
    constexpr double kGhostReach = 6;  // in units of d
    const double last =
        nodes.owned(i) ? std::numeric_limits<double>::infinity() : kGhostReach * nodes.d(i);
    constrained_star(in_, i, std::max(reach, nodes.d(i)), last, out);
  }

 private:
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
  std::vector<StarPoint> around_;
  std::int32_t bucket_ = -1;
  double least_ = 0;  // spacing in the buckets around
};

}  // namespace

void DelaunayStars::build(const StarInput& input) {
  stars_.build("pnpbs::DelaunayStars::build", input.nodes.count, [&] { return StarWriter(input); });
}

}  // namespace pnpbs
