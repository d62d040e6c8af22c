// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/volume/surface_rings.hpp"

#include <cmath>
#include <limits>

#include "delaunay/volume/tangent_star.hpp"

namespace pnpbs {

namespace {

// Finds the stars of consecutive nodes.
class RingWriter {
 public:
  RingWriter(const SurfaceStarInput& input, std::vector<double>& needs)
      : in_(input), needs_(needs), joined_([this](std::int32_t a, std::int32_t b) {
          return !on_facet(a) && !on_facet(b) &&
                 in_.features.joined(in_.nodes.boundary_node(a), in_.nodes.boundary_node(b));
        }) {}
  RingWriter(const RingWriter&) = delete;
  RingWriter& operator=(const RingWriter&) = delete;

  void operator()(std::int64_t i, std::vector<std::int32_t>& out) {
    star_.clear();
    needs_[static_cast<std::size_t>(i)] = find(i);
    for (const SurfaceStarEntry& entry : star_)
      out.push_back(2 * entry.node + (entry.triangle ? 1 : 0));
  }

 private:
  bool on_facet(std::int64_t i) const { return in_.nodes.carrier(i) == Carrier::surface; }

  // Finds the star of node i from ever larger neighbourhoods. Returns 0, or the distance up to
  // which this rank must know all nodes to find it. If all nodes have been examined without
  // success, the node has no star, and 0 is returned.
  double find(std::int64_t i) {
    constexpr double kFirst = 2;  // Sufficient for most stars. [d]
    const double everywhere = 2 * in_.tree.side();
    for (double reach = kFirst * in_.nodes.d(i);; reach *= 2) {
      const bool all = !(reach < everywhere);
      if (all) reach = everywhere;
      if (!in_.known.covers(in_.tree, box_around<3>(in_.nodes.position(i), reach))) return reach;
      const double sure = all ? std::numeric_limits<double>::infinity() : reach;
      if (look_around(i, reach) && find_within(i, sure)) return 0;
      if (all) return 0;
    }
  }

  bool find_within(std::int64_t i, double reach) {
    const SurfaceStarPoint centre{in_.nodes.position(i), in_.nodes.id(i),
                                  static_cast<std::int32_t>(i)};
    return tangent_star(centre, reach, sides_, joined_, star_);
  }

  // Collects the nodes visible on each side of node i. Returns false if a neighbour on a curve is
  // beyond the reach.
  bool look_around(std::int64_t i, double reach) {
    gather(i, reach);
    sides_.clear();
    bool complete = true;
    in_.surface.for_sides(in_.place(i), [&](const SurfaceSide& side) {
      StarSide& own = sides_.emplace_back();
      own.normal = side.normal;
      own.first = neighbour_on_curve(i, side.begin, complete);
      own.last = neighbour_on_curve(i, side.end, complete);
      for (const std::int32_t j : around_)
        if (j == own.first || j == own.last || in_.surface.sees(side, in_.place(j)))
          own.around.push_back({in_.nodes.position(j), in_.nodes.id(j), j});
    });
    return complete;
  }

  void gather(std::int64_t i, double reach) {
    around_.clear();
    const Point<3> x = in_.nodes.position(i);
    in_.tree.for_leaves_in(box_around<3>(x, reach), [&](std::int32_t leaf) {
      for (std::int32_t j = in_.buckets.begin(leaf); j < in_.buckets.end(leaf); ++j)
        if (j != i && squared_distance<3>(x, in_.nodes.position(j)) <= reach * reach)
          around_.push_back(j);
    });
  }

  std::int32_t neighbour_on_curve(std::int64_t i, const CurveDirection& way, bool& complete) const {
    if (way.curve < 0) return -1;
    const std::int32_t wanted = in_.features.next(in_.nodes.boundary_node(i), way);
    for (const std::int32_t j : around_)
      if (!on_facet(j) && in_.nodes.boundary_node(j) == wanted) return j;
    complete = false;
    return -1;
  }

  const SurfaceStarInput& in_;
  std::vector<double>& needs_;
  Joined joined_;
  std::vector<std::int32_t> around_;
  std::vector<StarSide> sides_;
  std::vector<SurfaceStarEntry> star_;
};

}  // namespace

void SurfaceRings::build(const SurfaceStarInput& input) {
  needs_.assign(static_cast<std::size_t>(input.nodes.count), 0);
  rows_.build("pnpbs::SurfaceRings::build", input.nodes.count,
              [&] { return RingWriter(input, needs_); });
}

}  // namespace pnpbs
