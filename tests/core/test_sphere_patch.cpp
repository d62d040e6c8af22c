// SPDX-License-Identifier: BSD-3-Clause
// Values at nodes on a sphere: linear on the triangles below it, extrapolated from the border, and
// independent of the distribution of the triangles. Results are compared with plain loops over all
// triangles.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "quick_assert.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"
#include "spacing/mesh_patch.hpp"
#include "spacing/sphere_patch.hpp"

using pnpbs::SpherePatch;
using Patch = pnpbs::Patch<2, 3>;
using Answer = pnpbs::PatchAnswer<2>;
using P = pnpbs::Point<3>;
using Triangle = std::array<std::int32_t, 3>;

namespace {

constexpr double kRadius = 3;

P on_sphere(const P& x) {
  const double length = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
  return {kRadius * x[0] / length, kRadius * x[1] / length, kRadius * x[2] / length};
}

P middle(const P& a, const P& b) { return on_sphere({a[0] + b[0], a[1] + b[1], a[2] + b[2]}); }

// Returns an octahedron without the face in the direction (1, 1, 1), whose other faces are cut in
// four three times.
Patch seven_octants(double (*value)(const P&)) {
  pnpbs::SphereField field;
  field.points = {{kRadius, 0, 0},  {0, kRadius, 0},  {0, 0, kRadius},
                  {-kRadius, 0, 0}, {0, -kRadius, 0}, {0, 0, -kRadius}};
  field.elements = {{1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
  for (int cut = 0; cut < 3; ++cut) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
    const auto between = [&](std::int32_t a, std::int32_t b) {
      const auto [at, is_new] =
          middles.insert({std::minmax(a, b), static_cast<std::int32_t>(field.points.size())});
      if (is_new)
        field.points.push_back(middle(field.points[static_cast<std::size_t>(a)],
                                      field.points[static_cast<std::size_t>(b)]));
      return at->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : field.elements) {
      const std::int32_t ab = between(a, b), bc = between(b, c), ca = between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    field.elements = finer;
  }
  for (const P& x : field.points) field.values.push_back(value(x));
  return pnpbs::patch_of_mesh<2, 3>(field);
}

double waves(const P& x) { return 2 + std::sin(x[0] + 0.5 * x[1]) * std::cos(x[2]); }

Answer ask(const std::vector<SpherePatch>& patches, const P& x) {
  Answer best;
  for (const auto how : {&SpherePatch::interpolate, &SpherePatch::extend}) {
    if (best.found()) return best;
    for (const SpherePatch& patch : patches) {
      Answer answer;
      (patch.*how)(x, answer);
      if (answer < best) best = answer;
    }
  }
  return best;
}

const P& node(const Patch& patch, std::int32_t i) {
  return patch.nodes[static_cast<std::size_t>(i)].x;
}

double determinant(const P& a, const P& b, const P& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// Returns the coefficients of x as a sum of the corners, by Cramer's rule. They are positive
// inside.
std::array<double, 3> parts_of(const Patch& patch, const Triangle& t, const P& x) {
  const P &a = node(patch, t[0]), &b = node(patch, t[1]), &c = node(patch, t[2]);
  const double whole = determinant(a, b, c);
  return {determinant(x, b, c) / whole, determinant(a, x, c) / whole, determinant(a, b, x) / whole};
}

// Returns the value at x, or NaN if no triangle contains it by more than rounding.
double plain_value(const Patch& patch, const P& x) {
  for (const Triangle& t : patch.simplices) {
    const auto [a, b, c] = parts_of(patch, t, x);
    if (std::min({a, b, c}) < 0) continue;
    const auto value = [&](std::size_t k) {
      return patch.nodes[static_cast<std::size_t>(t[k])].value;
    };
    return (a * value(0) + b * value(1) + c * value(2)) / (a + b + c);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

// Returns the value at the nearest of many points on the arcs of the border.
double plain_border_value(const Patch& patch, const P& x) {
  constexpr int kPlaces = 2000;
  double least = std::numeric_limits<double>::infinity(), value = 0;
  for (const auto& [a, b] : patch.border)
    for (int k = 0; k <= kPlaces; ++k) {
      const double t = static_cast<double>(k) / kPlaces;
      P y;
      for (std::size_t i = 0; i < 3; ++i)
        y[i] = (1 - t) * node(patch, a)[i] + t * node(patch, b)[i];
      const double gap = pnpbs::squared_distance<3>(x, on_sphere(y));
      if (gap >= least) continue;
      least = gap;
      value = (1 - t) * patch.nodes[static_cast<std::size_t>(a)].value +
              t * patch.nodes[static_cast<std::size_t>(b)].value;
    }
  return value;
}

std::vector<P> random_points(Random& random, int n) {
  std::vector<P> points;
  for (int i = 0; i < n; ++i)
    points.push_back(on_sphere(random.point<3>({{-1, -1, -1}, {1, 1, 1}})));
  return points;
}

}  // namespace

START_TEST(interpolates_on_the_ray_and_extends_from_the_border) {
  Random random(3);
  const Patch patch = seven_octants(waves);
  const std::vector<SpherePatch> one{SpherePatch(patch, kRadius)};
  int inside = 0;
  for (const P& x : random_points(random, 400)) {
    const Answer answer = ask(one, x);
    const double plain = plain_value(patch, x);
    if (std::isnan(plain)) {
      quick_assert(answer.gap > 0 && std::fabs(answer.value - plain_border_value(patch, x)) < 1e-3);
    } else {
      ++inside;
      quick_assert(answer.gap == 0 && std::fabs(answer.value - plain) < 1e-14);
    }
  }
  ck_assert_int_gt(inside, 300);
  ck_assert_int_lt(inside, 390);
}
END_TEST

// A transfer uses these weights. They reproduce the value; beyond the border, the triangle behind
// it is extrapolated if it is known.
START_TEST(weights_make_up_the_answer) {
  Random random(4);
  Patch patch = seven_octants(waves);
  for (const auto& [a, b] : patch.border)
    for (const Triangle& t : patch.simplices)
      if (std::count(t.begin(), t.end(), a) + std::count(t.begin(), t.end(), b) == 2)
        for (const std::int32_t third : t)
          if (third != a && third != b) patch.behind.push_back(third);
  ck_assert_uint_eq(patch.behind.size(), patch.border.size());
  const SpherePatch one(patch, kRadius);
  for (const P& x : random_points(random, 400)) {
    const Answer answer = ask({one}, x);
    const pnpbs::PatchWeights<2> w = one.weights(x, answer.row);
    double sum = 0, value = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      sum += w.weights[k];
      value += w.weights[k] * patch.nodes[static_cast<std::size_t>(w.nodes[k])].value;
    }
    quick_assert(std::fabs(sum - 1) < 1e-14 && w.inside == (answer.gap == 0));
    if (w.inside) {
      quick_assert(std::fabs(value - answer.value) < 1e-14);
      continue;
    }
    const std::array<double, 3> parts = parts_of(patch, w.nodes, x);
    const double all = parts[0] + parts[1] + parts[2];
    for (std::size_t k = 0; k < 3; ++k) {
      const double expected = all > 1 ? parts[k] / all : parts[k] + (1 - all) / 3;
      quick_assert(std::fabs(w.weights[k] - expected) < 1e-9);
    }
  }
  const Triangle& t = patch.simplices[17];
  const pnpbs::PatchWeights<2> w = one.weights(node(patch, t[1]), 17);
  quick_assert(w.inside && w.weights[0] == 0 && w.weights[1] == 1 && w.weights[2] == 0);
}
END_TEST

// At 90 degrees from a triangle no ray meets its plane, and farther away only backward rays do.
START_TEST(weights_are_bounded_far_away) {
  Patch patch;
  constexpr double kSide = 0.1;
  for (const P& x : {P{1, 0, 0}, P{1, kSide, 0}, P{1, 0, kSide}})
    patch.nodes.push_back({on_sphere(x), std::ssize(patch.nodes), 0});
  patch.simplices = {{0, 1, 2}};
  patch.border = {{0, 1}, {0, 2}, {1, 2}};
  patch.behind = {2, 1, 0};
  const SpherePatch one(patch, kRadius);
  constexpr int kSteps = 720;
  for (int k = 0; k < kSteps; ++k) {
    const double angle = 2 * std::acos(-1.0) * k / kSteps;
    for (const P& x :
         {P{std::cos(angle), std::sin(angle), 0}, P{std::cos(angle), 0, std::sin(angle)}})
      for (const double weight : one.weights(on_sphere(x), ask({one}, on_sphere(x)).row).weights)
        quick_assert(std::fabs(weight) < 2 / kSide);
  }
}
END_TEST

// Equal results also at nodes and on edges, which belong to several triangles.
START_TEST(the_same_however_distributed) {
  Random random(5);
  Patch patch = seven_octants(waves);
  std::vector<P> points = random_points(random, 200);
  for (const Triangle& t : patch.simplices) {
    points.push_back(node(patch, t[0]));
    points.push_back(middle(node(patch, t[0]), node(patch, t[1])));
  }
  const std::vector<SpherePatch> whole{SpherePatch(patch, kRadius)};
  for (const std::size_t many : {2u, 3u, 7u}) {
    std::vector<Patch> parts(many);
    for (Patch& part : parts) part.nodes = patch.nodes;
    const auto any = [&]() -> Patch& {
      return parts[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(many)))];
    };
    random.shuffle(patch.simplices);
    for (const Triangle& t : patch.simplices) any().simplices.push_back(t);
    for (const auto& side : patch.border) any().border.push_back(side);
    std::vector<SpherePatch> patches;
    for (const Patch& part : parts) patches.emplace_back(part, kRadius);
    for (const P& x : points) {
      const Answer a = ask(whole, x), b = ask(patches, x);
      quick_assert(a.ids == b.ids && a.gap == b.gap && a.value == b.value);
    }
  }
}
END_TEST

TEST_SUITE(test_sphere_patch) {
  return run_kernel_suite("sphere_patch", {interpolates_on_the_ray_and_extends_from_the_border,
                                           weights_make_up_the_answer, weights_are_bounded_far_away,
                                           the_same_however_distributed});
}
