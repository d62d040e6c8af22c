// SPDX-License-Identifier: BSD-3-Clause
#include "cases.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

namespace pnpbs_bench {

namespace {

const Loop kSquare{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

// ------------------------------------------------------------------ an airfoil -----------------

// Returns NACA 2412 with a closed trailing edge and chord 1 from the origin. Points are dense at
// both ends (Jacobs, Ward, Pinkerton 1933; NACA report 460).
Loop airfoil(int per_side) {
  constexpr double kCamber = 0.02, kCamberAt = 0.4, kThickness = 0.12, kPi = 3.14159265358979323846;
  const auto point = [&](int k, double side) -> std::array<double, 2> {
    const double x = 0.5 * (1 - std::cos(kPi * k / per_side));
    const double half =
        5 * kThickness *
        (0.2969 * std::sqrt(x) + x * (-0.1260 + x * (-0.3516 + x * (0.2843 - x * 0.1036))));
    const double along = x < kCamberAt ? kCamberAt : 1 - kCamberAt;
    const double rest = x < kCamberAt ? 0 : 1 - 2 * kCamberAt;
    const double y = kCamber / (along * along) * (rest + 2 * kCamberAt * x - x * x);
    const double slope = 2 * kCamber / (along * along) * (kCamberAt - x);
    const double norm = std::hypot(1, slope);
    return {x - side * half * slope / norm, y + side * half / norm};
  };
  Loop loop;
  for (int k = per_side; k > 0; --k) loop.push_back(point(k, 1));   // over the top to the front
  for (int k = 0; k < per_side; ++k) loop.push_back(point(k, -1));  // and back below
  return loop;
}

// Distance to a closed loop. Groups of segments whose circle is too far away are skipped.
class DistanceToLoop {
 public:
  explicit DistanceToLoop(Loop loop) : loop_(std::move(loop)) {
    for (std::size_t first = 0; first < loop_.size(); first += kGroup) {
      const std::size_t last = std::min(first + kGroup, loop_.size());
      const auto &a = at(first), &b = at(last);
      Group group{{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])}, 0};
      for (std::size_t k = first; k <= last; ++k)
        group.radius = std::max(group.radius,
                                std::hypot(at(k)[0] - group.centre[0], at(k)[1] - group.centre[1]));
      groups_.push_back(group);
    }
  }

  double operator()(double x, double y) const {
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t start = 0;  // group with the nearest circle
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const double bound = beyond(g, x, y) + 2 * groups_[g].radius;
      if (bound >= nearest) continue;
      nearest = bound;
      start = g;
    }
    nearest = within(start, x, y);
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (g != start && beyond(g, x, y) < nearest) nearest = std::min(nearest, within(g, x, y));
    return nearest;
  }

 private:
  static constexpr std::size_t kGroup = 16;
  struct Group {
    std::array<double, 2> centre;
    double radius;
  };

  const std::array<double, 2>& at(std::size_t k) const { return loop_[k % loop_.size()]; }
  double beyond(std::size_t g, double x, double y) const {
    const Group& group = groups_[g];
    return std::hypot(x - group.centre[0], y - group.centre[1]) - group.radius;
  }
  double within(std::size_t g, double x, double y) const {
    double square = std::numeric_limits<double>::infinity();
    for (std::size_t k = g * kGroup; k < std::min((g + 1) * kGroup, loop_.size()); ++k) {
      const auto &a = at(k), &b = at(k + 1);
      const double ex = b[0] - a[0], ey = b[1] - a[1], rx = x - a[0], ry = y - a[1];
      const double t = std::clamp((rx * ex + ry * ey) / (ex * ex + ey * ey), 0.0, 1.0);
      square = std::min(square, std::pow(rx - t * ex, 2) + std::pow(ry - t * ey, 2));
    }
    return std::sqrt(square);
  }

  Loop loop_;
  std::vector<Group> groups_;
};

Case airfoil_case() {
  const Loop loop = airfoil(200);
  const auto distance = std::make_shared<const DistanceToLoop>(loop);
  return {
      "graded-airfoil",
      "",
      {{{-1, -1.5}, {2, -1.5}, {2, 1.5}, {-1, 1.5}}, loop},
      [distance](double x, double y) { return std::min(1.5e-4 + 0.15 * (*distance)(x, y), 0.15); }};
}

// ------------------------------------------------------------------ the study ------------------

// Returns the cases of the study. d grows from its smallest value with the distance to a shape, up
// to half of the growth, which is the value half of the square away.
std::vector<Case> study_cases() {
  struct Shape {
    const char* name;
    double (*distance)(double, double);
  };
  const Shape shapes[] = {
      {"line", [](double, double y) { return std::fabs(y - 0.5); }},
      {"layer", [](double, double y) { return y; }},
      {"point", [](double x, double y) { return std::hypot(x - 0.4, y - 0.45); }},
      {"points",
       [](double x, double y) {
         return std::min(std::hypot(x - 0.3, y - 0.4), std::hypot(x - 0.75, y - 0.7));
       }},
  };
  std::vector<Case> cases;
  for (const Shape& shape : shapes)
    for (double growth : {0.02, 0.05, 0.1, 0.2})
      for (double ratio : {10., 100., 1000.}) {
        char name[64];
        std::snprintf(name, sizeof name, "bands-%s-%g-%g", shape.name, growth, ratio);
        const double coarse = 0.5 * growth, fine = coarse / ratio;
        const auto distance = shape.distance;
        cases.push_back({name, "", {kSquare}, [=](double x, double y) {
                           return std::min(fine + growth * distance(x, y), coarse);
                         }});
        cases.back().in_study = true;
      }
  return cases;
}

Case constant_case(const char* name, const char* poly, double d) {
  Case c{name, poly, {kSquare}, [d](double, double) { return d; }};
  c.constant = true;
  return c;
}

}  // namespace

std::vector<Case> all_cases() {
  const auto from_point = [](double d, double growth, double x0, double y0) {
    return [=](double x, double y) { return d + growth * std::hypot(x - x0, y - y0); };
  };
  const auto from_line = [](double d) {
    return [=](double, double y) { return std::min(d + 0.2 * std::fabs(y - 0.5), 0.08); };
  };
  std::vector<Case> cases{
      {"graded-square", "", {kSquare}, from_point(0.00068, 9 * 0.00068 / 0.7071, 0.5, 0.5)},
      {"graded-line", "", {kSquare}, from_line(0.0001)},
      {"graded-line-coarse", "", {kSquare}, from_line(0.0005)},
      airfoil_case(),
      {"graded-victoria", "lake_victoria.poly", {}, from_point(0.35, 0.006, 0, 0)},
      {"graded-lakes", "great_lakes_islands.poly", {}, from_point(0.3, 0.006, 0, 0)},
      constant_case("uniform-square", "", 0.0034),
      constant_case("uniform-victoria", "lake_victoria.poly", 0.8947),
      constant_case("uniform-lakes", "great_lakes_islands.poly", 1.5),
  };
  for (Case& c : study_cases()) cases.push_back(std::move(c));
  return cases;
}

}  // namespace pnpbs_bench
