// SPDX-License-Identifier: BSD-3-Clause
// Centroids of Voronoi cells against sums over a fine grid, in the plane and on a sphere; the
// lattice as a fixed point; the decrease of the energy by sweeps; and the repair of obtuse
// triangles.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/space_vectors.hpp"
#include "distorted_nodes.hpp"
#include "quality/plane/centroidal_sweep.hpp"
#include "run_kernel_suite.hpp"

using Level = pnpbs::Level<2>;
using pnpbs::PlaneDomain, pnpbs::StereographicChart;
using P = pnpbs::Point<2>;

namespace {

const Build kSquare = [](PlaneDomain& p) { shapes::add_loop(p, shapes::rectangle(0, 0, 1, 1)); };

P middle_of_pixel(const P& low, double width, int row, int column) {
  return {low[0] + (column + 0.5) * width, low[1] + (row + 0.5) * width};
}

// Returns node i and its neighbours. In the cell of i, the nearest node is one of them.
std::vector<P> sites_around(const Level& level, std::int64_t i) {
  std::vector<P> sites{level.nodes.position(i)};
  level.stars.for_neighbours(i, [&](std::int64_t j) { sites.push_back(level.nodes.position(j)); });
  return sites;
}

template <class Distance>
bool is_nearest_to_first(const std::vector<P>& sites, const P& x, const Distance& distance) {
  const double first = distance(x, sites[0]);
  return std::none_of(sites.begin() + 1, sites.end(),
                      [&](const P& site) { return distance(x, site) < first; });
}

// Calls add(x, mass) for the pixels of a grid that lie in the cell of node i, by distance(x, y) and
// density(x).
template <class Distance, class Density, class Add>
void for_pixels_of_cell(const Level& level, std::int64_t i, const Distance& distance,
                        const Density& density, const Add& add) {
  constexpr int kPixels = 600;
  const std::vector<P> sites = sites_around(level, i);
  const double reach = 2.2 * level.nodes.d(i), width = 2 * reach / kPixels;
  const P low{sites[0][0] - reach, sites[0][1] - reach};
  for (int row = 0; row < kPixels; ++row)
    for (int column = 0; column < kPixels; ++column) {
      const P x = middle_of_pixel(low, width, row, column);
      if (is_nearest_to_first(sites, x, distance)) add(x, density(x));
    }
}

bool is_deep_inside(const Level& level, std::int64_t i) {
  const P x = level.nodes.position(i);
  return level.nodes.moves(i) && level.map().clearance(x, 1) > 3 * level.nodes.d(i);
}

double largest_angle_cosine(const Triangle& t, const Places& places) {
  double least = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const P a = places.at(t[k]), b = places.at(t[(k + 1) % 3]), c = places.at(t[(k + 2) % 3]);
    const P ab{b[0] - a[0], b[1] - a[1]}, ac{c[0] - a[0], c[1] - a[1]};
    least =
        std::min(least, pnpbs::dot(ab, ac) / std::sqrt(pnpbs::dot(ab, ab) * pnpbs::dot(ac, ac)));
  }
  return least;
}

double smallest_angle(const Triangle& t, const Places& places) {
  double least = 180;
  for (std::size_t k = 0; k < 3; ++k) {
    const P a = places.at(t[k]), b = places.at(t[(k + 1) % 3]), c = places.at(t[(k + 2) % 3]);
    const double turn = std::atan2(b[1] - a[1], b[0] - a[0]) - std::atan2(c[1] - a[1], c[0] - a[0]);
    least = std::min(least, std::fabs(std::remainder(turn, 2 * std::numbers::pi)));
  }
  return least * 180 / std::numbers::pi;
}

// Returns the measure of the repair, for which an angle of 35 degrees is as bad as one of 90
// degrees.
double worst_angle(const Triangle& t, const Places& places) {
  const double sine = std::sin(smallest_angle(t, places) / 180 * std::numbers::pi);
  return std::min(largest_angle_cosine(t, places),
                  sine / std::sin(35.0 / 180 * std::numbers::pi) - 1);
}

}  // namespace

// d is linear in the square, so it is exact on triangles. The density moves the centroid by some
// hundredths of d.
START_TEST(centroid_as_by_pixels) {
  const Plane d = [](double x, double y) { return 0.02 + 0.06 * x + 0.03 * y; };
  LevelRun run = distorted(kSquare, d, 300, {});
  pnpbs::refresh_spacing(*run.level);
  const Level& level = *run.level;
  const pnpbs::CellCentroids centroids(level.nodes, level.stars, {});
  int tried = 0;
  double moved = 0;
  for (std::int64_t i = 0; i < level.nodes.count && tried < 60; ++i) {
    if (!is_deep_inside(level, i)) continue;
    ++tried;
    double mass = 0, plain_mass = 0;
    P sum{}, plain{};
    for_pixels_of_cell(
        level, i, [](const P& x, const P& y) { return pnpbs::distance<2>(x, y); },
        [&](const P& x) { return std::pow(d(x[0], x[1]), -4); },
        [&](const P& x, double rho) {
          mass += rho;
          plain_mass += 1;
          for (const std::size_t k : {0U, 1U}) {
            sum[k] += rho * x[k];
            plain[k] += x[k];
          }
        });
    const P expected{sum[0] / mass, sum[1] / mass},
        without{plain[0] / plain_mass, plain[1] / plain_mass};
    ck_assert_double_lt(pnpbs::distance<2>(centroids.of(i), expected), 1e-3 * level.nodes.d(i));
    moved = std::max(moved, pnpbs::distance<2>(expected, without) / level.nodes.d(i));
  }
  ck_assert_int_eq(tried, 60);
  ck_assert_double_gt(moved, 0.02);
}
END_TEST

// The same nodes in a chart, with constant d on the sphere. The tolerance is the curvature within a
// cell.
START_TEST(centroid_on_a_sphere_as_by_pixels) {
  const StereographicChart chart(0.5, {0.3, -0.2, 1});
  const Plane d = [&](double x, double y) { return 0.05 * chart.stretch({x, y}); };
  LevelRun run = distorted(kSquare, d, 310, {});
  pnpbs::refresh_spacing(*run.level);
  const Level& level = *run.level;
  const pnpbs::CellCentroids centroids(level.nodes, level.stars, chart);
  int tried = 0;
  double off_plane = 0;
  for (std::int64_t i = 0; i < level.nodes.count && tried < 15; ++i) {
    if (!is_deep_inside(level, i)) continue;
    ++tried;
    pnpbs::Point<3> sum{};
    for_pixels_of_cell(
        level, i, [&](const P& x, const P& y) { return chart.distance(x, y); },
        [&](const P& x) { return std::pow(chart.stretch(x), -2); },
        [&](const P& x, double area) { sum = pnpbs::shifted(sum, area, chart.on_sphere(x)); });
    const P expected = chart.in_chart(sum), found = centroids.of(i);
    ck_assert_double_lt(pnpbs::distance<2>(found, expected), 7e-4 * level.nodes.d(i));
    const P in_plane = pnpbs::CellCentroids(level.nodes, level.stars, {}).of(i);
    off_plane = std::max(off_plane, pnpbs::distance<2>(in_plane, expected) / level.nodes.d(i));
  }
  ck_assert_int_eq(tried, 15);
  ck_assert_double_gt(off_plane, 1e-3);
}
END_TEST

// A lattice is centroidal. A displaced node returns to its lattice point if the others are fixed.
START_TEST(lattice_is_a_fixed_point) {
  constexpr double kD = 0.05;
  LevelRun run(kSquare, constant(kD));
  pnpbs::IncomingNodes<2> lattice;
  for (int row = 1; row < 22; ++row)
    for (int column = 1; column < 19; ++column) {
      const P x{kD * (column + 0.5 * (row % 2)), row * kD * std::sqrt(0.75)};
      lattice.push_back({x, std::ssize(lattice)});
    }
  pnpbs::take(*run.level, lattice, 0);
  run.renew_stars();
  Level& level = *run.level;
  const pnpbs::CellCentroids centroids(level.nodes, level.stars, {});
  std::int64_t middle = -1;
  for (std::int64_t i = 0; i < level.nodes.count; ++i) {
    if (!is_deep_inside(level, i)) continue;
    ck_assert_double_lt(pnpbs::distance<2>(centroids.of(i), level.nodes.position(i)), 1e-15);
    if (middle < 0 || std::fabs(level.nodes.x[0](i) - 0.5) < 0.5 * kD) middle = i;
  }
  for (std::int64_t i = 0; i < level.nodes.count; ++i)
    if (i != middle) level.nodes.carrier(i) = pnpbs::Carrier::fixed;
  const P place = level.nodes.position(middle);
  level.nodes.set_position(middle, {place[0] + 0.1 * kD, place[1] - 0.2 * kD});
  pnpbs::View<char> allowed = pnpbs::make_view<char>("allowed", level.nodes.count);
  for (int sweep = 0; sweep < 60; ++sweep)
    pnpbs::centroidal_sweep(level.nodes, level.stars, level.neighbourhood.near_boundary().edges(),
                            level.map(), {}, {1}, level.time_integration.scratch(level.nodes),
                            allowed);
  ck_assert_double_lt(pnpbs::distance<2>(level.nodes.position(middle), place), 1e-9 * kD);
}
END_TEST

namespace {

// Returns the sum over cells of the integral of d^-4 |x - node|^2, by the pixels of the square.
double energy(const Level& level, const Plane& d) {
  constexpr int kPixels = 400;
  double sum = 0;
  for (int row = 0; row < kPixels; ++row)
    for (int column = 0; column < kPixels; ++column) {
      const P x = middle_of_pixel({0, 0}, 1.0 / kPixels, row, column);
      double least = 1;
      for (std::int64_t i = 0; i < level.nodes.count; ++i)
        least = std::min(least, pnpbs::squared_distance<2>(x, level.nodes.position(i)));
      sum += std::pow(d(x[0], x[1]), -4) * least;
    }
  return sum;
}

}  // namespace

START_TEST(energy_falls) {
  const Plane d = [](double x, double y) { return 0.05 + 0.05 * x + 0.02 * y; };
  LevelRun run = distorted(kSquare, d, 320, {});
  double last = energy(*run.level, d);
  const double first = last;
  for (int block = 0; block < 6; ++block) {
    pnpbs::refresh_spacing(*run.level);
    pnpbs::sweep_to_centroids(*run.level, block < 4 ? 1 : 5);
    const double now = energy(*run.level, d);
    ck_assert_double_lt(now, last * (1 + 1e-5));
    last = now;
  }
  ck_assert_double_lt(last, 0.9 * first);
}
END_TEST

START_TEST(obtuse_triangles_become_fewer) {
  std::int64_t before = 0, after = 0;
  std::uint64_t seed = 330;
  for (const Shape& shape : shapes_to_finish()) {
    LevelRun run = distorted(shape.build, shape.d, ++seed, {});
    pnpbs::sweep_to_centroids(*run.level, 5);
    run.renew_stars();
    const std::vector<Triangle> triangles = triangles_by_id(*run.level);
    const Places were = places_by_id(*run.level);
    pnpbs::repair_obtuse_triangles(*run.level, 20);
    const Places are = places_by_id(*run.level);
    for (const Triangle& t : triangles) {
      before += largest_angle_cosine(t, were) < 0;
      after += largest_angle_cosine(t, are) < 0;
      const double was = worst_angle(t, were), bound = std::cos(89.5 / 180 * std::numbers::pi);
      quick_assert(worst_angle(t, are) > std::min(was, bound) - 1e-9);
    }
  }
  ck_assert_int_gt(before, 20);
  ck_assert_int_lt(2 * after, before);
}
END_TEST

TEST_SUITE(test_centroidal_sweep) {
  return run_kernel_suite("centroidal_sweep",
                          {centroid_as_by_pixels, centroid_on_a_sphere_as_by_pixels,
                           lattice_is_a_fixed_point, energy_falls, obtuse_triangles_become_fewer});
}
