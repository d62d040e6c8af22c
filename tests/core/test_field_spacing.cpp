// SPDX-License-Identifier: BSD-3-Clause
// A spacing from values at the nodes of a mesh or at scattered points: linear functions, values at
// the points, bounds by the neighbours' values, extrapolation, and invalid input.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/error.hpp"
#include "geometry/expect_error.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"
#include "spacing/given_field.hpp"
#include "spacing/scattered_spacing.hpp"
#include "spacing/sizing_field.hpp"
#include "unit_box.hpp"

namespace {

template <int Dim>
using Field = pnpbs::GivenField<Dim>;
template <int Dim>
using P = pnpbs::Point<Dim>;

template <int Dim>
double linear(const P<Dim>& x) {
  double value = 2;
  for (int k = 0; k < Dim; ++k) value += (0.5 - 0.3 * k) * x[k];
  return value;
}

template <int Dim>
double value_at(const pnpbs::Spacing<Dim>& spacing, const P<Dim>& x) {
  double d = -1;
  spacing.evaluate(1, &x, &d);
  return d;
}

// Returns the unit cube in n^Dim cells with randomly moved inner nodes. Each cell is cut along its
// diagonal into Dim! simplices with corners in any order.
template <int Dim>
Field<Dim> mesh_of_cube(Random& random, int n) {
  Field<Dim> field;
  std::array<std::int32_t, 3> step{1, n + 1, (n + 1) * (n + 1)};
  const int layers = Dim == 3 ? n : 0;
  for (int c = 0; c <= layers; ++c)
    for (int b = 0; b <= n; ++b)
      for (int a = 0; a <= n; ++a) {
        const std::array<int, 3> at{a, b, c};
        P<Dim> x;
        for (int k = 0; k < Dim; ++k) {
          const int i = at[static_cast<std::size_t>(k)];
          x[k] = (i + (i > 0 && i < n ? random.between(-0.1, 0.1) : 0)) / n;
        }
        field.points.push_back(x);
        field.values.push_back(linear<Dim>(x));
      }
  std::array<std::size_t, Dim> way;
  for (int c = 0; c < std::max(layers, 1); ++c)
    for (int b = 0; b < n; ++b)
      for (int a = 0; a < n; ++a) {
        for (std::size_t k = 0; k < Dim; ++k) way[k] = k;
        do {
          std::array<std::int32_t, Dim + 1> corners;
          corners[0] = a + b * step[1] + c * step[2];
          for (std::size_t k = 0; k < Dim; ++k) corners[k + 1] = corners[k] + step[way[k]];
          random.shuffle(corners);
          field.elements.push_back(corners);
        } while (std::next_permutation(way.begin(), way.end()));
      }
  random.shuffle(field.elements);
  return field;
}

template <int Dim>
Field<Dim> cloud(Random& random, int n) {
  Field<Dim> field;
  for (int i = 0; i < n; ++i) {
    field.points.push_back(random.point<Dim>(unit_box<Dim>()));
    field.values.push_back(linear<Dim>(field.points.back()));
  }
  return field;
}

template <int Dim>
auto spacing_from(const Field<Dim>& field) {
  return pnpbs::spacing_from_field(field, unit_box<Dim>());
}

// ------------------------------------------------------------------ meshes ---------------------

template <int Dim>
void check_linear_in_mesh(int n) {
  Random random(3);
  const auto spacing = spacing_from(mesh_of_cube<Dim>(random, n));
  for (int k = 0; k < 2000; ++k) {
    const P<Dim> x = random.point<Dim>(unit_box<Dim>());
    ck_assert_double_eq_tol(value_at<Dim>(*spacing, x), linear<Dim>(x), 1e-14);
  }
}

START_TEST(a_linear_function_on_a_mesh) {
  check_linear_in_mesh<2>(9);
  check_linear_in_mesh<3>(5);
}
END_TEST

// Outside the cube, the nearest point is found by clamping each coordinate.
template <int Dim>
void check_beyond_mesh(int n) {
  Random random(4);
  const auto spacing = spacing_from(mesh_of_cube<Dim>(random, n));
  pnpbs::Box<Dim> wide;
  wide.low.fill(-2);
  wide.high.fill(3);
  for (int k = 0; k < 2000; ++k) {
    const P<Dim> x = random.point<Dim>(wide);
    P<Dim> nearest = x;
    for (double& c : nearest) c = std::clamp(c, 0.0, 1.0);
    ck_assert_double_eq_tol(value_at<Dim>(*spacing, x), linear<Dim>(nearest), 1e-13);
  }
}

START_TEST(beyond_a_mesh_its_nearest_point_counts) {
  check_beyond_mesh<2>(7);
  check_beyond_mesh<3>(4);
}
END_TEST

// Two halves share no nodes, and their values differ by a factor of ten. The jump stays sharp; on
// it the element with the smallest node index is used.
START_TEST(a_jump_between_parts_of_a_mesh) {
  Field<2> field;
  field.points = {{0, 0}, {0.5, 0}, {0.5, 1}, {0, 1}, {0.5, 0}, {1, 0}, {1, 1}, {0.5, 1}};
  field.values = {0.1, 0.1, 0.1, 0.1, 1, 1, 1, 1};
  field.elements = {{4, 5, 6}, {0, 1, 2}, {4, 6, 7}, {0, 3, 2}};
  const auto spacing = spacing_from(field);
  const double below = std::nextafter(0.5, 0.0), above = std::nextafter(0.5, 1.0);
  for (const double y : {0.0, 0.3, 0.7, 1.0}) {
    ck_assert_double_eq(value_at<2>(*spacing, {below, y}), 0.1);
    ck_assert_double_eq(value_at<2>(*spacing, {0.5, y}), 0.1);
    ck_assert_double_eq(value_at<2>(*spacing, {above, y}), 1);
  }
}
END_TEST

// A sliver has a height of one rounding error: d still stays between the values at its corners.
START_TEST(a_mesh_with_a_sliver) {
  Field<2> field;
  field.points = {{0, 0}, {1, 1}, {0.3, std::nextafter(0.3, 1.0)}, {1, 0}};
  field.values = {1, 2, 3, 1};
  field.elements = {{0, 1, 2}, {0, 1, 3}};
  const auto spacing = spacing_from(field);
  Random random(5);
  for (int k = 0; k < 1000; ++k) {
    const double t = random.between(-0.5, 1.5);
    for (const double y : {t, std::nextafter(t, 2.0), std::nextafter(t, -2.0)}) {
      const double d = value_at<2>(*spacing, {t, y});
      ck_assert_msg(d >= 1 && d <= 3, "%g at %g", d, t);
    }
  }
}
END_TEST

// ------------------------------------------------------------------ scattered points -----------

template <int Dim>
void check_points_of_cloud(int n) {
  Random random(6);
  Field<Dim> field = cloud<Dim>(random, n);
  for (double& value : field.values) value = random.between(0.1, 2);
  const auto spacing = spacing_from(field);
  for (std::size_t i = 0; i < field.points.size(); ++i)
    ck_assert_double_eq(value_at<Dim>(*spacing, field.points[i]), field.values[i]);
  // Values close to a point are close to that of the point, as d is continuous.
  for (std::size_t i = 0; i < field.points.size(); ++i) {
    P<Dim> x = field.points[i];
    x[0] += 1e-9;
    ck_assert_double_eq_tol(value_at<Dim>(*spacing, x), field.values[i], 1e-5);
  }
}

START_TEST(values_are_met_at_the_points) {
  check_points_of_cloud<2>(400);
  check_points_of_cloud<3>(300);
}
END_TEST

// Checks that d lies between the values of the nearest points, which are found by a search over
// all.
template <int Dim>
void check_bounds_in_cloud(int n) {
  Random random(7);
  Field<Dim> field = cloud<Dim>(random, n);
  for (double& value : field.values) value = random.between(0.1, 2);
  const auto spacing = spacing_from(field);
  pnpbs::Box<Dim> wide;
  wide.low.fill(-1);
  wide.high.fill(2);
  for (int k = 0; k < 500; ++k) {
    const P<Dim> x = random.point<Dim>(k % 2 == 0 ? unit_box<Dim>() : wide);
    std::vector<std::pair<double, double>> near;
    for (std::size_t i = 0; i < field.points.size(); ++i)
      near.emplace_back(pnpbs::squared_distance<Dim>(field.points[i], x), field.values[i]);
    std::sort(near.begin(), near.end());
    double min = near[0].second, max = min;
    for (std::size_t i = 0; i < pnpbs::ScatteredSpacing<Dim>::kNeighbours; ++i) {
      min = std::min(min, near[i].second);
      max = std::max(max, near[i].second);
    }
    const double d = value_at<Dim>(*spacing, x), rounding = 1e-14;
    ck_assert_msg(d >= min - rounding && d <= max + rounding, "%g is not in %g .. %g", d, min, max);
  }
}

START_TEST(values_stay_between_those_of_neighbours) {
  check_bounds_in_cloud<2>(300);
  check_bounds_in_cloud<3>(300);
}
END_TEST

template <int Dim>
void check_constant_cloud(int n) {
  Random random(14);
  Field<Dim> field = cloud<Dim>(random, n);
  field.values.assign(field.values.size(), 0.3);
  const auto spacing = spacing_from(field);
  for (int k = 0; k < 500; ++k)
    ck_assert_double_eq(value_at<Dim>(*spacing, random.point<Dim>(unit_box<Dim>())), 0.3);
}

START_TEST(a_constant_cloud) {
  check_constant_cloud<2>(100);
  check_constant_cloud<3>(100);
}
END_TEST

// A linear function is reproduced at most points. Elsewhere the error is a fraction of its change
// over the distance to the nearest point.
template <int Dim>
void check_linear_in_cloud(int n) {
  Random random(8);
  const Field<Dim> field = cloud<Dim>(random, n);
  const auto spacing = spacing_from(field);
  pnpbs::Box<Dim> amid;
  amid.low.fill(0.2);
  amid.high.fill(0.8);
  int met = 0, all = 2000;
  double squares = 0;
  for (int k = 0; k < all; ++k) {
    const P<Dim> x = random.point<Dim>(amid);
    const double error = std::fabs(value_at<Dim>(*spacing, x) - linear<Dim>(x));
    met += error < 1e-8;
    squares += error * error;
  }
  const double apart = std::pow(1.0 / n, 1.0 / Dim), mean = std::sqrt(squares / all);
  ck_assert_msg(met > 0.5 * all, "%d of %d", met, all);
  ck_assert_msg(mean < 0.05 * apart, "%g, the points are %g apart", mean, apart);
}

START_TEST(a_linear_function_amid_a_cloud) {
  check_linear_in_cloud<2>(500);
  check_linear_in_cloud<3>(2000);
}
END_TEST

// Returns the error for a smooth function, which decreases as the number of points grows.
template <int Dim>
double error_with_points(int n) {
  Random random(15);
  const auto wave = [](const P<Dim>& x) {
    double value = 2;
    for (int k = 0; k < Dim; ++k) value += 0.5 * std::sin(4 * x[k] + k);
    return value;
  };
  Field<Dim> field = cloud<Dim>(random, n);
  for (std::size_t i = 0; i < field.points.size(); ++i) field.values[i] = wave(field.points[i]);
  const auto spacing = spacing_from(field);
  double squares = 0;
  const int all = 2000;
  for (int k = 0; k < all; ++k) {
    const P<Dim> x = random.point<Dim>(unit_box<Dim>());
    const double error = value_at<Dim>(*spacing, x) - wave(x);
    squares += error * error;
  }
  return std::sqrt(squares / all);
}

START_TEST(a_smooth_function_in_a_dense_cloud) {
  ck_assert_double_lt(error_with_points<2>(30000), 2e-3);
  ck_assert_double_lt(error_with_points<2>(30000), 0.1 * error_with_points<2>(300));
  ck_assert_double_lt(error_with_points<3>(20000), 1e-2);
  ck_assert_double_lt(error_with_points<3>(20000), 0.2 * error_with_points<3>(300));
}
END_TEST

// Fine points lie within a shell of coarse ones, with more coarse points far around. Beyond the
// shell most of the directions have coarse points, even if the nearest points are fine. A plane
// fitted to the nearest points would extrapolate wildly.
template <int Dim>
P<Dim> middle_of_group() {
  P<Dim> x;
  for (std::size_t k = 0; k < Dim; ++k) x[k] = std::array{0.52, 0.47, 0.55}[k];
  return x;
}

template <int Dim>
Field<Dim> group_within_a_shell() {
  Field<Dim> field;
  const auto add = [&](const P<Dim>& from, const P<Dim>& way, double part, double d) {
    P<Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = from[k] + part * way[k];
    field.points.push_back(x);
    field.values.push_back(d);
  };
  P<Dim> middle;
  middle.fill(0.5);
  for (int i = 0; i < (Dim == 2 ? 9 : 27); ++i) {
    const std::array<int, 3> thirds{i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
    P<Dim> way;
    double square = 0;
    for (std::size_t k = 0; k < Dim; ++k) {
      way[k] = thirds[k];
      square += way[k] * way[k];
    }
    add(middle, way, 0.5, 0.1);
    if (square == 0) continue;
    add(middle_of_group<Dim>(), way, 0.005 / std::sqrt(square), 0.1);
    add(middle_of_group<Dim>(), way, 0.003 / std::sqrt(square), 0.001);
  }
  return field;
}

template <int Dim>
void check_group_within_a_shell() {
  Random random(16);
  const auto spacing = spacing_from(group_within_a_shell<Dim>());
  int beyond = 0;
  for (int k = 0; k < 5000; ++k) {
    P<Dim> x = random.point<Dim>(unit_box<Dim>());
    if (k % 2 == 0)
      for (int c = 0; c < Dim; ++c) x[c] = middle_of_group<Dim>()[c] + 0.05 * (x[c] - 0.5);
    if (pnpbs::distance<Dim>(x, middle_of_group<Dim>()) < 0.007) continue;
    ++beyond;
    ck_assert_double_eq_tol(value_at<Dim>(*spacing, x), 0.1, 0.005);
  }
  ck_assert_int_gt(beyond, 4000);
}

START_TEST(what_is_behind_a_shell_does_not_count) {
  check_group_within_a_shell<2>();
  check_group_within_a_shell<3>();
}
END_TEST

START_TEST(the_order_of_a_cloud_changes_nothing) {
  Random random(9);
  Field<3> field = cloud<3>(random, 200), other = field;
  std::vector<std::size_t> order(field.points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  random.shuffle(order);
  for (std::size_t i = 0; i < order.size(); ++i) {
    other.points[i] = field.points[order[i]];
    other.values[i] = field.values[order[i]];
  }
  const auto a = spacing_from(field), b = spacing_from(other);
  for (int k = 0; k < 500; ++k) {
    const P<3> x = random.point<3>(unit_box<3>());
    ck_assert_double_eq(value_at<3>(*a, x), value_at<3>(*b, x));
  }
}
END_TEST

// Degenerate sets of points: few points, points on a line, on a circle around x, or on a grid.
START_TEST(clouds_without_an_inside) {
  Field<2> one;
  one.points = {{0.5, 0.5}};
  one.values = {0.25};
  ck_assert_double_eq(value_at<2>(*spacing_from(one), {7, 3}), 0.25);

  Field<2> line;
  for (int i = 0; i <= 20; ++i) {
    line.points.push_back({i / 20.0, 0.5});
    line.values.push_back(1 + i / 20.0);
  }
  const auto along = spacing_from(line);
  for (int k = 0; k < 100; ++k) {
    ck_assert_double_eq_tol(value_at<2>(*along, {0.3 + 0.004 * k, 0.5}), 1.3 + 0.004 * k, 1e-8);
    const double aside = value_at<2>(*along, {0.3 + 0.004 * k, 0.7});
    ck_assert_double_eq_tol(aside, 1.3 + 0.004 * k, 0.03);
  }

  Field<2> circle;
  circle.points = {{3, 4},   {4, 3},   {-3, 4}, {-4, 3}, {3, -4}, {4, -3},
                   {-3, -4}, {-4, -3}, {5, 0},  {-5, 0}, {0, 5},  {0, -5}};
  circle.values.assign(12, 0.5);
  circle.values[3] = 1;
  const double amid = value_at<2>(*spacing_from(circle), {0, 0});
  ck_assert_msg(amid >= 0.5 && amid <= 1, "%g", amid);

  Field<3> grid;
  for (int i = 0; i < 1000; ++i) {
    grid.points.push_back({i % 10 / 8.0, i / 10 % 10 / 8.0, i / 100 / 8.0});
    grid.values.push_back(linear<3>(grid.points.back()));
  }
  const auto spacing = spacing_from(grid);
  Random random(10);
  for (int i = 100; i < 800; ++i) {  // cell centres: the nearest points are all equally far
    const P<3> x{(i % 8 + 0.5) / 8, (i / 8 % 8 + 0.5) / 8, (i / 100 + 0.5) / 8};
    const double d = value_at<3>(*spacing, x);
    ck_assert_double_eq_tol(d, linear<3>(x), 0.2);
  }
}
END_TEST

// ------------------------------------------------------------------ hints ----------------------

// A linear function has the same slope on each element.
template <int Dim>
void check_slopes(int n) {
  Random random(12);
  const auto spacing = spacing_from(mesh_of_cube<Dim>(random, n));
  pnpbs::SizingField<Dim> twice = pnpbs::SizingField<Dim>(spacing).multiplied(2);
  twice.set_bound(1e9);
  const pnpbs::SpacingHints<Dim> known = twice.spacing_hints();
  double square = 0;
  for (int k = 0; k < Dim; ++k) square += (0.5 - 0.3 * k) * (0.5 - 0.3 * k);
  ck_assert(!known.slopes.empty());
  for (const auto& slope : known.slopes)
    ck_assert_double_eq_tol(slope.growth, 2 * std::sqrt(square), 1e-9);
  for (const auto& value : known.values)
    ck_assert_double_eq_tol(value.d, 2 * linear<Dim>(value.x), 1e-12);
}

START_TEST(slopes_of_a_mesh) {
  check_slopes<2>(6);
  check_slopes<3>(3);
}
END_TEST

START_TEST(slopes_of_a_cloud) {
  Random random(13);
  const pnpbs::SpacingHints<3> known = spacing_from(cloud<3>(random, 200))->spacing_hints();
  ck_assert_uint_eq(known.values.size(), 200);
  for (const auto& slope : known.slopes)
    ck_assert(slope.growth <= std::sqrt(0.25 + 0.04 + 0.01) + 1e-9);
}
END_TEST

// ------------------------------------------------------------------ invalid input --------------

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

template <int Dim>
void expect_refused(const Field<Dim>& field, pnpbs::ErrorKind kind, const char* text) {
  expect_error(kind, {text}, [&] { spacing_from(field); });
}

START_TEST(what_is_refused) {
  using pnpbs::ErrorKind;
  Random random(11);
  const Field<2> mesh = mesh_of_cube<2>(random, 3);
  Field<2> bad = mesh;
  bad.values[5] = kNan;
  expect_refused(bad, ErrorKind::spacing, "d[5]");
  bad.values[5] = -1;
  expect_refused(bad, ErrorKind::spacing, "= -1");
  bad.values[5] = 0;
  expect_refused(bad, ErrorKind::spacing, "greater than 0");
  bad = mesh;
  bad.points[3][1] = kNan;
  expect_refused(bad, ErrorKind::argument, "coordinates[3] is (1, nan)");
  bad = mesh;
  bad.elements[2] = {0, 1, 1};
  expect_refused(bad, ErrorKind::argument, "corners[2]: the triangle");
  bad.elements[2] = {0, 1, 2};
  bad.points[0] = {0, 0}, bad.points[1] = {0.25, 0}, bad.points[2] = {0.5, 0};
  expect_refused(bad, ErrorKind::argument, "flat");
  bad = mesh;
  for (P<2>& x : bad.points) x = {1000 * x[0] + 2000, x[1]};
  expect_refused(bad, ErrorKind::spacing, "at least 1999 from it");
  bad.elements.clear();
  expect_refused(bad, ErrorKind::spacing, "outside of the domain");
  bad.points = {{0.5, 0.5}, {0.25, 0.75}, {0.5, 0.5}};
  bad.values = {1, 2, 1};
  // The same value given twice.
  ck_assert_double_eq(value_at<2>(*spacing_from(bad), {0.5, 0.5}), 1);
  bad.values[2] = 3;
  expect_refused(bad, ErrorKind::spacing, "d[0] = 1 and argument d[2] = 3 are both at (0.5, 0.5)");
  bad.points.clear(), bad.values.clear();
  expect_refused(bad, ErrorKind::argument, "no point");
}
END_TEST

}  // namespace

TEST_SUITE(test_field_spacing) {
  return run_kernel_suite(
      "spacing from given values",
      {a_linear_function_on_a_mesh, beyond_a_mesh_its_nearest_point_counts,
       a_jump_between_parts_of_a_mesh, a_mesh_with_a_sliver, values_are_met_at_the_points,
       values_stay_between_those_of_neighbours, a_constant_cloud, a_linear_function_amid_a_cloud,
       a_smooth_function_in_a_dense_cloud, what_is_behind_a_shell_does_not_count,
       the_order_of_a_cloud_changes_nothing, clouds_without_an_inside, slopes_of_a_mesh,
       slopes_of_a_cloud, what_is_refused});
}
