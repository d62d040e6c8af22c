// SPDX-License-Identifier: BSD-3-Clause
#include "implicit/level_set.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/point_text.hpp"
#include "base/space_vectors.hpp"

namespace pnpbs {
namespace {

constexpr std::size_t kBatch = std::size_t{1} << 16;  // most points in one evaluation of f
// Factor of the first search step over the distance to f = 0 estimated from the slope. Further
// steps double.
constexpr double kFirstStep = 1.25;

// A search along a line for a point at which f has the other sign.
struct Search {
  std::size_t point;
  double f;
  Point<3> along;  // unit
  double step;
};

}  // namespace

LevelSet::LevelSet(std::string name, LevelSetFunction f, const Box<3>& box, double resolution)
    : name_(std::move(name)), f_(std::move(f)), box_(box), resolution_(resolution) {}

std::vector<double> LevelSet::values(std::span<const Point<3>> x) const {
  std::vector<double> values(x.size());
  for (std::size_t begin = 0; begin < x.size(); begin += kBatch) {
    const std::size_t n = std::min(kBatch, x.size() - begin);
    f_(static_cast<std::int64_t>(n), x.data() + begin, values.data() + begin);
  }
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!std::isfinite(values[i]))
      throw Error(ErrorKind::domain, name_ + ": f is " + number_text(values[i]) + " at " +
                                         point_text(x[i]) +
                                         ", expected a finite number everywhere in the box");
  return values;
}

Point<3> LevelSet::in_box(Point<3> x) const {
  for (std::size_t k = 0; k < 3; ++k) x[k] = std::clamp(x[k], box_.low[k], box_.high[k]);
  return x;
}

Point<3> LevelSetSlope::normal() const { return unit_vector(gradient); }

std::vector<LevelSetSlope> LevelSet::slopes(std::span<const Point<3>> x, double step) const {
  constexpr std::size_t kValues = 7;  // at the point, then below and above in each direction
  std::vector<Point<3>> around;
  for (const Point<3>& place : x) {
    const Point<3> middle = in_box(place);
    around.push_back(middle);
    for (std::size_t k = 0; k < 3; ++k)
      for (const double side : {-1.0, 1.0}) {
        Point<3> there = middle;
        there[k] += side * step * resolution_;
        around.push_back(in_box(there));
      }
  }
  const std::vector<double> f = values(around);
  std::vector<LevelSetSlope> slopes;
  for (std::size_t i = 0; i < f.size(); i += kValues) {
    LevelSetSlope slope{around[i], f[i], {}, 0};
    double kink = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t low = i + 1 + 2 * k, high = low + 1;
      const double below = around[i][k] - around[low][k], above = around[high][k] - around[i][k];
      if (below + above > 0) slope.gradient[k] = (f[high] - f[low]) / (below + above);
      if (below > 0 && above > 0)
        kink = std::max(kink, std::fabs((f[high] - f[i]) / above - (f[i] - f[low]) / below));
    }
    const double whole = length(slope.gradient);
    slope.kink = whole > 0 ? kink / whole : 0;
    slopes.push_back(slope);
  }
  return slopes;
}

std::vector<double> LevelSet::distances_along(std::span<const Point<3>> x,
                                              std::span<const Point<3>> directions) const {
  const double step = kSlopeStep * resolution_;
  std::vector<Point<3>> around;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (const double way : {0.0, -step, step})
      around.push_back(in_box(shifted(x[i], way, directions[i])));
  const std::vector<double> f = values(around);
  std::vector<double> ways(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    ways[i] = std::fabs(f[3 * i]) * distance<3>(around[3 * i + 1], around[3 * i + 2]) /
              std::fabs(f[3 * i + 2] - f[3 * i + 1]);
  return ways;
}

std::vector<char> LevelSet::project(std::span<Point<3>> x, double reach) const {
  const std::vector<LevelSetSlope> slope = slopes(x);
  std::vector<char> found(x.size());
  std::vector<Search> open;
  for (std::size_t i = 0; i < x.size(); ++i) {
    found[i] = slope[i].f == 0;
    const double f = slope[i].f, way = std::fabs(f) / length(slope[i].gradient);
    if (f == 0 || !(way <= reach)) continue;
    const Point<3> along = shifted({}, f < 0 ? 1 : -1, slope[i].normal());
    open.push_back({i, f, along, std::min(reach, kFirstStep * way)});
  }
  std::vector<std::size_t> crossing;
  std::vector<CrossedSegment> segments;
  while (!open.empty()) {
    std::vector<Point<3>> tried;
    for (const Search& s : open) tried.push_back(in_box(shifted(x[s.point], s.step, s.along)));
    const std::vector<double> there = values(tried);
    std::vector<Search> farther;
    for (std::size_t k = 0; k < open.size(); ++k) {
      Search s = open[k];
      if ((s.f < 0) != (there[k] < 0)) {
        crossing.push_back(s.point);
        segments.push_back({x[s.point], tried[k], s.f, there[k]});
      } else if (s.step < reach) {
        s.step = std::min(reach, 2 * s.step);
        farther.push_back(s);
      }
    }
    open = std::move(farther);
  }
  const std::vector<Point<3>> zeros = zeros_on(*this, segments);
  for (std::size_t k = 0; k < crossing.size(); ++k) {
    x[crossing[k]] = zeros[k];
    found[crossing[k]] = 1;
  }
  return found;
}

namespace {

// Most steps of the iteration.
constexpr int kMaxSteps = 60;
constexpr double kEndTolerance = 1e-10;  // [length of the segment]

// The remaining part of a segment; a and b are fractions of its length.
struct Bracket {
  std::size_t segment;
  Point<3> way;
  double a, b, fa, fb;
  int last = 0;  // the end that moved last: 1 for a, 2 for b
};

}  // namespace

// Uses false position in the Illinois form, which always keeps the two points between which f
// changes sign.
std::vector<Point<3>> zeros_on(const LevelSet& set, const std::vector<CrossedSegment>& segments) {
  std::vector<Bracket> open;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const CrossedSegment& s = segments[i];
    open.push_back({i, difference(s.end, s.begin), 0, 1, s.f_begin, s.f_end});
  }
  std::vector<Point<3>> zeros(segments.size());
  for (int step = 0; step < kMaxSteps && !open.empty(); ++step) {
    std::vector<double> parts;
    std::vector<Point<3>> x;
    for (const Bracket& s : open) {
      parts.push_back(s.a + (s.b - s.a) * (s.fa / (s.fa - s.fb)));
      x.push_back(shifted(segments[s.segment].begin, parts.back(), s.way));
    }
    const std::vector<double> f = set.values(x);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < open.size(); ++k) {
      Bracket s = open[k];
      const double part = parts[k];
      zeros[s.segment] = x[k];
      if (f[k] == 0 || std::min(part - s.a, s.b - part) <= kEndTolerance) continue;
      const bool low = (f[k] < 0) == (s.fa < 0);
      (low ? s.a : s.b) = part;
      (low ? s.fa : s.fb) = f[k];
      const int moved = low ? 1 : 2;
      if (s.last == moved) (low ? s.fb : s.fa) *= 0.5;
      s.last = moved;
      open[kept++] = s;
    }
    open.resize(kept);
  }
  return zeros;
}

}  // namespace pnpbs
