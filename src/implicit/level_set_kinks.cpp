// SPDX-License-Identifier: BSD-3-Clause
#include "implicit/level_set_kinks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/space_vectors.hpp"

namespace pnpbs {

namespace {

constexpr double kNearer = 0.1;       // factor of the reach if both sides were sampled
constexpr double kFarther = 2.5;      // factor of the reach if only one side was sampled
constexpr int kMaxRounds = 24;        // for an edge; five are usual
constexpr double kMinSine = 0.05;     // least sine of the angle between two sides
constexpr double kFarthest = 4;       // largest distance from the starting points [their distance]
constexpr double kStepOfReach = 0.1;  // step of differences, which must stay on one side [reach]

double differences_at(double reach, const LevelSet& set) {
  return std::clamp(kStepOfReach * reach / set.resolution(), kStepOfReach * kKinkReach,
                    LevelSet::kSlopeStep);
}

// ------------------------------------------------------------------ edges ----------------------

// A tangent plane, intersected with the plane of a search.
struct Line {
  Point<2> x;
  double f;
  Point<2> gradient;
  Point<3> normal;  // in space
};

double cross_2d(const Point<2>& a, const Point<2>& b) { return a[0] * b[1] - a[1] * b[0]; }

class KinkFinder {
 public:
  KinkFinder(std::size_t number, const CreaseSearch& search, const LevelSet& set)
      : number_(number),
        origin_(search.sides[0]),
        least_(kKinkReach * set.resolution()),
        next_(search.sides) {
    const Point<3> way = difference(search.sides[1], search.sides[0]);
    along_ = unit_vector(way);
    up_ = unit_vector(part_across(search.up, along_));
    reach_ = gap_ = std::max(length(way), least_ / kNearer);
  }

  std::size_t number() const { return number_; }
  const std::array<Point<3>, 2>& next() const { return next_; }
  double reach() const { return reach_; }

  enum class State { open, found, none };

  // Processes the slopes at the two points of next().
  State take(const LevelSetSlope& low, const LevelSetSlope& high) {
    const std::array<Line, 2> lines{line_of(low), line_of(high)};
    bool both = true;
    if (round_++ == 0) {
      sides_ = lines;
      const Point<3> turn = difference(low.normal(), high.normal());
      convex_ = dot(difference(next_[1], next_[0]), turn) < 0;
    } else {
      const bool first_low = is_like_first(lines[0]), first_high = is_like_first(lines[1]);
      if (!first_low && first_high) return State::none;
      if (first_low) sides_[0] = first_high ? lines[1] : lines[0];
      if (!first_high) sides_[1] = first_low ? lines[1] : lines[0];
      both = first_low != first_high;
    }
    if (turn_less(sides_[0].normal, sides_[1].normal, kKinkAngle / 2) || !meet())
      return State::none;
    if (both && reach_ <= least_) return is_kink() ? State::found : State::none;
    if (round_ == kMaxRounds) return State::none;
    // If the two points were on different sides, search nearer. Otherwise the other side was
    // measured too far away, so search farther.
    reach_ = both ? std::max(kNearer * reach_, least_) : std::min(kFarther * reach_, gap_);
    next_ = {in_space(beside(0)), in_space(beside(1))};
    return State::open;
  }

  CreasePoint result() const { return {in_space(meet_), {sides_[0].normal, sides_[1].normal}}; }

 private:
  Line line_of(const LevelSetSlope& slope) const {
    const Point<3> from = difference(slope.x, origin_);
    return {{dot(from, along_), dot(from, up_)},
            slope.f,
            {dot(slope.gradient, along_), dot(slope.gradient, up_)},
            slope.normal()};
  }

  bool is_like_first(const Line& line) const {
    return dot(line.normal, sides_[0].normal) > dot(line.normal, sides_[1].normal);
  }

  bool is_kink() const {
    constexpr double kAside = 3;  // largest distance from a sample to the meeting point [reach]
    return !turn_less(sides_[0].normal, sides_[1].normal, kKinkAngle) &&
           std::max(distance<2>(meet_, sides_[0].x), distance<2>(meet_, sides_[1].x)) <
               kAside * least_;
  }

  Point<3> in_space(const Point<2>& x) const {
    return shifted(shifted(origin_, x[0], along_), x[1], up_);
  }

  // Computes the intersection of both lines. Returns false if they are nearly parallel or if it is
  // too far away.
  bool meet() {
    const auto& [a, b] = sides_;
    const double sine = cross_2d(a.gradient, b.gradient);
    if (!(std::fabs(sine) > kMinSine * std::hypot(a.gradient[0], a.gradient[1]) *
                                std::hypot(b.gradient[0], b.gradient[1])))
      return false;
    const auto value = [](const Line& l) {
      return l.gradient[0] * l.x[0] + l.gradient[1] * l.x[1] - l.f;
    };
    const double va = value(a), vb = value(b);
    meet_ = {(va * b.gradient[1] - vb * a.gradient[1]) / sine,
             (a.gradient[0] * vb - b.gradient[0] * va) / sine};
    return meet_[0] > -gap_ && meet_[0] < 2 * gap_ && std::fabs(meet_[1]) < kFarthest * gap_;
  }

  // Returns the point at distance reach_ from the intersection on one side, along its tangent. The
  // other line is negative there if f is the larger of both, else positive.
  Point<2> beside(std::size_t side) const {
    const Line& line = sides_[side];
    const Line& other = sides_[1 - side];
    const double slope = std::hypot(line.gradient[0], line.gradient[1]);
    const Point<2> way{-line.gradient[1] / slope, line.gradient[0] / slope};
    const double rise = other.gradient[0] * way[0] + other.gradient[1] * way[1];
    const double step = (rise < 0) == convex_ ? reach_ : -reach_;
    return {meet_[0] + step * way[0], meet_[1] + step * way[1]};
  }

  std::size_t number_;
  Point<3> origin_, along_, up_;
  double gap_, reach_, least_;
  std::array<Point<3>, 2> next_;
  std::array<Line, 2> sides_{};
  Point<2> meet_{};
  bool convex_ = false;
  int round_ = 0;
};

}  // namespace

bool turn_less(const Point<3>& normal, const Point<3>& other, double angle) {
  return dot(normal, other) > std::cos(angle);
}

std::vector<std::optional<CreasePoint>> find_crease_points(
    const LevelSet& set, const std::vector<CreaseSearch>& searches) {
  std::vector<std::optional<CreasePoint>> found(searches.size());
  std::vector<KinkFinder> open;
  for (std::size_t i = 0; i < searches.size(); ++i) open.emplace_back(i, searches[i], set);
  // Searches with the same step of differences are evaluated together.
  while (!open.empty()) {
    std::vector<KinkFinder> farther;
    std::stable_sort(open.begin(), open.end(), [&](const KinkFinder& a, const KinkFinder& b) {
      return differences_at(a.reach(), set) > differences_at(b.reach(), set);
    });
    for (std::size_t begin = 0, end; begin < open.size(); begin = end) {
      const double step = differences_at(open[begin].reach(), set);
      std::vector<Point<3>> x;
      for (end = begin; end < open.size() && differences_at(open[end].reach(), set) == step; ++end)
        x.insert(x.end(), open[end].next().begin(), open[end].next().end());
      const std::vector<LevelSetSlope> slopes = set.slopes(x, step);
      for (std::size_t k = begin; k < end; ++k) {
        const KinkFinder::State state =
            open[k].take(slopes[2 * (k - begin)], slopes[2 * (k - begin) + 1]);
        if (state == KinkFinder::State::found) found[open[k].number()] = open[k].result();
        if (state == KinkFinder::State::open) farther.push_back(open[k]);
      }
    }
    open = std::move(farther);
  }
  return found;
}

// ------------------------------------------------------------------ corners --------------------

namespace {

struct Plane {
  Point<3> x, normal;
  double gap;  // distance of x from the plane
};

// Returns the point with the least sum of squared distances to the planes, or nothing if they do
// not determine it.
std::optional<Point<3>> common_point(const std::vector<Plane>& planes) {
  // Least squared volume spanned by the normals, which is 1 for orthogonal ones.
  constexpr double kMinVolume = 0.01;
  std::array<Point<3>, 3> rows{};
  Point<3> right{};
  const Point<3>& origin = planes.front().x;
  for (const Plane& p : planes) {
    const double offset = dot(p.normal, difference(p.x, origin)) - p.gap;
    for (std::size_t k = 0; k < 3; ++k) rows[k] = shifted(rows[k], p.normal[k], p.normal);
    right = shifted(right, offset, p.normal);
  }
  const double volume = dot(rows[0], cross(rows[1], rows[2]));
  if (!(volume > kMinVolume)) return {};
  Point<3> x{};
  for (std::size_t k = 0; k < 3; ++k)  // the matrix is symmetric
    x = shifted(x, right[k] / volume, cross(rows[(k + 1) % 3], rows[(k + 2) % 3]));
  return shifted(origin, 1, x);
}

class CornerFinder {
 public:
  CornerFinder(const LevelSet& set, const Point<3>& x, std::vector<CornerSide> sides)
      : set_(set), near_(x), sides_(std::move(sides)) {}

  std::optional<Point<3>> run() {
    constexpr double kFirstReach = 0.1, kFarthestCorner = 1.8;  // [resolution]
    const double h = set_.resolution();
    std::vector<Plane> planes;
    for (const CornerSide& side : sides_)
      for (const Point<3>& x : side.samples) planes.push_back({x, side.normal, 0});
    std::optional<Point<3>> x = common_point(planes);
    for (double reach = kFirstReach * h, last = kFarthestCorner * h;;
         last = 3 * reach, reach *= kNearer) {
      if (!x || distance<3>(*x, near_) > last) return {};
      if (reach < 0.5 * kKinkReach * h) break;
      near_ = *x;
      planes = planes_around(*x, reach);
      if (planes.size() < sides_.size()) return {};
      x = common_point(planes);
    }
    for (const CornerSide& a : sides_)
      for (const CornerSide& b : sides_)
        if (&a != &b && turn_less(a.normal, b.normal, kKinkAngle / 2)) return {};
    return x;
  }

 private:
  // Returns directions from x into the side: to the middle of its samples, then to each sample.
  std::vector<Point<3>> ways(const CornerSide& side, const Point<3>& x) const {
    std::vector<Point<3>> ways{{}};
    for (const Point<3>& sample : side.samples) {
      const Point<3> way = unit_vector(part_across(difference(sample, x), side.normal));
      ways.front() = shifted(ways.front(), 1, way);
      ways.push_back(way);
    }
    ways.front() = unit_vector(ways.front());
    return ways;
  }

  // Returns a tangent plane of each side at distance `reach` from x. Stops at the first side whose
  // normal is not found.
  std::vector<Plane> planes_around(const Point<3>& x, double reach) {
    std::vector<Plane> planes;
    for (CornerSide& side : sides_) {
      std::vector<Point<3>> places;
      for (const Point<3>& way : ways(side, x)) places.push_back(shifted(x, reach, way));
      const std::vector<LevelSetSlope> slopes = set_.slopes(places, differences_at(reach, set_));
      const auto at = std::find_if(slopes.begin(), slopes.end(), [&](const LevelSetSlope& slope) {
        return is_of(slope.normal(), side);
      });
      if (at == slopes.end()) break;
      planes.push_back({at->x, at->normal(), at->f / length(at->gradient)});
    }
    for (std::size_t k = 0; k < planes.size(); ++k) sides_[k].normal = planes[k].normal;
    return planes;
  }

  bool is_of(const Point<3>& normal, const CornerSide& side) const {
    return turn_less(normal, side.normal, kKinkAngle / 2) &&
           std::none_of(sides_.begin(), sides_.end(), [&](const CornerSide& other) {
             return dot(normal, other.normal) > dot(normal, side.normal);
           });
  }

  const LevelSet& set_;
  Point<3> near_;
  std::vector<CornerSide> sides_;
};

}  // namespace

std::optional<Point<3>> find_corner(const LevelSet& set, const Point<3>& x,
                                    std::vector<CornerSide> sides) {
  return CornerFinder(set, x, std::move(sides)).run();
}

}  // namespace pnpbs
