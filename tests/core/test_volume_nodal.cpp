// SPDX-License-Identifier: BSD-3-Clause
// A spacing from values at the nodes of tetrahedra: linear on each, from the one with the smallest
// ids if several contain a point, extrapolated from the border. Results are compared with integer
// arithmetic and loops over all.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "nodal_parts.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"
#include "spacing/nodal_spacing.hpp"
#include "surfaces.hpp"

using surfaces::Place;
using surfaces::Wide;
using P = pnpbs::Point<3>;
using Patch = pnpbs::Patch<3>;
using Answer = pnpbs::PatchAnswer<3>;
using Tetrahedron = std::array<std::int32_t, 4>;
using Values = double (*)(const P&);

namespace {

constexpr int kCells = 5;
constexpr std::int64_t kStep = 60;

double linear(const P& x) { return 400 + x[0] - 0.5 * x[1] + 0.25 * x[2]; }
double waves(const P& x) { return 2 + std::sin(0.05 * x[0]) * std::cos(0.03 * x[1] + 0.04 * x[2]); }

P point_of(const Place& x) {
  return {static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])};
}

// A grid of cubes with randomly moved inner nodes, each cube cut into six tetrahedra along its
// diagonal, with shuffled ids. A cube near the middle is missing.
struct ShakenGrid {
  std::vector<Place> places;
  Patch patch;
  surfaces::Surface border;

  ShakenGrid(Random& random, Values function) {
    constexpr int kNodes = kCells + 1;
    std::vector<std::int64_t> ids(kNodes * kNodes * kNodes);
    for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = 100 + static_cast<std::int64_t>(i);
    random.shuffle(ids);
    for (std::int64_t n = 0; n < std::ssize(ids); ++n) {
      Place x{n % kNodes, n / kNodes % kNodes, n / kNodes / kNodes};
      const bool inner = *std::min_element(x.begin(), x.end()) > 0 &&
                         *std::max_element(x.begin(), x.end()) < kCells;
      x = kStep * x;
      for (std::int64_t& along : x) along += inner ? 2 * (random.below(13) - 6) : 0;
      places.push_back(x);
      patch.nodes.push_back({point_of(x), ids[static_cast<std::size_t>(n)], function(point_of(x))});
    }
    for (int cell = 0; cell < kCells * kCells * kCells; ++cell) {
      const std::array<int, 3> at{cell % kCells, cell / kCells % kCells, cell / kCells / kCells};
      if (at != std::array{2, 2, 2}) add_cube(at);
    }
    find_border();
  }

  template <std::size_t N>
  std::array<std::int64_t, N> ids_of(const std::array<std::int32_t, N>& row) const {
    std::array<std::int64_t, N> ids;
    for (std::size_t k = 0; k < N; ++k) ids[k] = patch.nodes[static_cast<std::size_t>(row[k])].id;
    return ids;
  }
  const Place& place(std::int32_t node) const { return places[static_cast<std::size_t>(node)]; }
  double value(std::int32_t node) const {
    return patch.nodes[static_cast<std::size_t>(node)].value;
  }

 private:
  void add_cube(const std::array<int, 3>& at) {
    std::array<int, 3> order{0, 1, 2};
    do {
      std::array<int, 3> corner = at;
      Tetrahedron tetrahedron;
      for (std::size_t k = 0;; ++k) {
        tetrahedron[k] = corner[0] + (kCells + 1) * (corner[1] + (kCells + 1) * corner[2]);
        if (k == 3) break;
        ++corner[static_cast<std::size_t>(order[k])];
      }
      std::sort(tetrahedron.begin(), tetrahedron.end(), [&](std::int32_t a, std::int32_t b) {
        return patch.nodes[static_cast<std::size_t>(a)].id <
               patch.nodes[static_cast<std::size_t>(b)].id;
      });
      patch.simplices.push_back(tetrahedron);
    } while (std::next_permutation(order.begin(), order.end()));
  }

  // Collects the faces that belong to one tetrahedron only.
  void find_border() {
    std::map<std::array<std::int32_t, 3>, int> sides;
    for (const auto& [a, b, c, d] : patch.simplices)
      for (const std::array<std::int32_t, 3>& side :
           {std::array{a, b, c}, std::array{a, b, d}, std::array{a, c, d}, std::array{b, c, d}})
        ++sides[side];
    for (const auto& [side, times] : sides)
      if (times == 1) patch.border.push_back(side);
    border.nodes = places;
    border.triangles = patch.border;
  }
};

// Returns six times the volumes of the tetrahedra in which x replaces each corner.
std::array<Wide, 4> parts(const ShakenGrid& grid, const Tetrahedron& t, const Place& x) {
  std::array<Wide, 4> volumes;
  for (std::size_t k = 0; k < 4; ++k) {
    std::array<Place, 4> corner;
    for (std::size_t l = 0; l < 4; ++l) corner[l] = l == k ? x : grid.place(t[l]);
    volumes[k] =
        dot(surfaces::cross(corner[1] - corner[0], corner[2] - corner[0]), corner[3] - corner[0]);
  }
  return volumes;
}

// Returns the value from the tetrahedron with the smallest ids that contains x.
Answer expected_inside(const ShakenGrid& grid, const Place& x) {
  Answer best;
  for (const Tetrahedron& t : grid.patch.simplices) {
    const std::array<Wide, 4> share = parts(grid, t, x);
    const auto [low, high] = std::minmax_element(share.begin(), share.end());
    if (*low < 0 && *high > 0) continue;
    if (best.found() && !(grid.ids_of(t) < best.ids)) continue;
    long double sum = 0, all = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      sum += static_cast<long double>(share[k]) * grid.value(t[k]);
      all += static_cast<long double>(share[k]);
    }
    best = {0, grid.ids_of(t), static_cast<double>(sum / all)};
  }
  return best;
}

// Returns nodes, midpoints of edges, centres of triangles and tetrahedra rounded to integers, and
// random points.
std::vector<Place> places_in(const ShakenGrid& grid, Random& random) {
  std::vector<Place> places = grid.places;
  for (const auto& [a, b, c, d] : grid.patch.simplices) {
    for (Place x : {grid.place(a) + grid.place(b), grid.place(c) + grid.place(d)}) {
      for (std::int64_t& along : x) along /= 2;
      places.push_back(x);
    }
    Place x = grid.place(b) + grid.place(c) + grid.place(d);
    for (std::int64_t& along : x) along /= 3;
    places.push_back(x);
  }
  for (int n = 0; n < 2000; ++n) {
    Place x;
    for (std::int64_t& along : x) along = random.below(kCells * kStep + 1);
    places.push_back(x);
  }
  return places;
}

}  // namespace

START_TEST(linear_functions_are_exact) {
  Random random(1);
  const ShakenGrid grid(random, linear);
  const pnpbs::NodalSpacing<3> spacing(pnpbs::serial_communicator(), grid.patch);
  std::vector<P> points;
  for (const Place& x : places_in(grid, random))
    if (expected_inside(grid, x).found()) points.push_back(point_of(x));
  for (int n = 0; n < 5000; ++n)
    points.push_back(random.point<3>({{0, 0, 0}, {kCells * kStep, kCells * kStep, kStep - 15}}));
  std::vector<double> d(points.size());
  spacing.evaluate(std::ssize(points), points.data(), d.data());
  for (std::size_t i = 0; i < points.size(); ++i)
    quick_assert(std::fabs(d[i] - linear(points[i])) < 2e-13 * 400);
}
END_TEST

START_TEST(interpolates_in_the_tetrahedron_of_min_ids) {
  Random random(2);
  const ShakenGrid grid(random, waves);
  const pnpbs::NodalPatch<3> one(grid.patch);
  int shared = 0, outside = 0;
  for (const Place& x : places_in(grid, random)) {
    const Answer expected = expected_inside(grid, x);
    Answer answer;
    one.interpolate(point_of(x), answer);
    quick_assert(answer.found() == expected.found());
    outside += !expected.found();
    if (!expected.found()) continue;
    quick_assert(answer.ids == expected.ids && answer.gap == 0);
    quick_assert(std::fabs(answer.value - expected.value) < 1e-13);
    int holding = 0;
    for (const Tetrahedron& t : grid.patch.simplices) {
      const std::array<Wide, 4> share = parts(grid, t, x);
      const auto [low, high] = std::minmax_element(share.begin(), share.end());
      holding += *low >= 0 || *high <= 0;
    }
    shared += holding > 1;
  }
  ck_assert_int_gt(shared, 1000);
  ck_assert_int_gt(outside, 10);
}
END_TEST

namespace {

// Returns the value from the border triangle nearest to x. Distances equal to sixteen digits count
// as ties, of which the triangle with the smallest ids is used.
Answer expected_outside(const ShakenGrid& grid, const Place& x, int& equally_near) {
  std::vector<long double> gaps;
  for (std::size_t t = 0; t < grid.patch.border.size(); ++t)
    gaps.push_back(surfaces::squared_gap(grid.border, t, x));
  const long double min = *std::min_element(gaps.begin(), gaps.end());
  Answer best;
  int near = 0;
  for (std::size_t t = 0; t < gaps.size(); ++t) {
    if (gaps[t] > min * (1 + 1e-16L)) continue;
    ++near;
    std::array<std::int64_t, 4> ids{};
    const auto corners = grid.ids_of(grid.patch.border[t]);
    std::copy(corners.begin(), corners.end(), ids.begin());
    if (!best.found() || ids < best.ids) best = {static_cast<double>(gaps[t]), ids, 0};
  }
  equally_near += near > 1;
  return best;
}

// Returns the value at the nearest of many points of the border.
double nearest_value(const ShakenGrid& grid, const P& x) {
  constexpr int kParts = 60;
  double min = std::numeric_limits<double>::infinity(), value = 0;
  for (const auto& [a, b, c] : grid.patch.border)
    for (int i = 0; i <= kParts; ++i)
      for (int j = 0; i + j <= kParts; ++j) {
        const double u = double(i) / kParts, v = double(j) / kParts;
        double gap = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          const double at = static_cast<double>(grid.place(a)[k]) * (1 - u - v) +
                            static_cast<double>(grid.place(b)[k]) * u +
                            static_cast<double>(grid.place(c)[k]) * v - x[k];
          gap += at * at;
        }
        if (gap >= min) continue;
        min = gap;
        value = (1 - u - v) * grid.value(a) + u * grid.value(b) + v * grid.value(c);
      }
  return value;
}

}  // namespace

START_TEST(extends_from_the_nearest_point_of_the_border) {
  Random random(3);
  const ShakenGrid grid(random, waves);
  const pnpbs::NodalPatch<3> one(grid.patch);
  int holes = 0, equally_near = 0;
  constexpr std::int64_t kSide = kCells * kStep;
  for (int n = 0; n < 1500; ++n) {
    Place x;
    for (std::int64_t& along : x)
      along = n % 3 == 0 ? 2 * kStep + random.below(kStep) : random.below(2 * kSide) - kSide / 2;
    if (expected_inside(grid, x).found()) continue;
    holes += n % 3 == 0;
    const Answer expected = expected_outside(grid, x, equally_near);
    Answer answer;
    one.extend(point_of(x), answer);
    quick_assert(std::fabs(std::sqrt(answer.gap) - std::sqrt(expected.gap)) < 1e-12);
    quick_assert(answer.ids == expected.ids);
    if (n % 5 == 0) quick_assert(std::fabs(answer.value - nearest_value(grid, point_of(x))) < 0.03);
  }
  ck_assert_int_gt(holes, 200);
  ck_assert_int_gt(equally_near, 200);
}
END_TEST

// Results are equal to the bit on faces, at nodes, inside and outside.
START_TEST(the_same_however_distributed) {
  Random random(4);
  const ShakenGrid grid(random, waves);
  std::vector<P> points;
  for (const Place& x : places_in(grid, random)) points.push_back(point_of(x));
  for (int n = 0; n < 1000; ++n)
    points.push_back(random.point<3>({{-50, -50, -50}, {350, 350, 350}}));
  expect_the_same_however_distributed<3>(grid.patch, points, random);
}
END_TEST

// The value at a node is the given one, independent of the tetrahedron used.
START_TEST(nodes_have_their_values) {
  Random random(5);
  const ShakenGrid grid(random, waves);
  const pnpbs::NodalPatch<3> one(grid.patch);
  for (const auto& node : grid.patch.nodes) {
    Answer answer;
    one.interpolate(node.x, answer);
    quick_assert(std::fabs(answer.value - node.value) < 2e-15);
  }
}
END_TEST

TEST_SUITE(test_volume_nodal) {
  return run_kernel_suite(
      "volume_nodal", {linear_functions_are_exact, interpolates_in_the_tetrahedron_of_min_ids,
                       extends_from_the_nearest_point_of_the_border, the_same_however_distributed,
                       nodes_have_their_values});
}
