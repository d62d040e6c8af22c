// SPDX-License-Identifier: BSD-3-Clause
// Signs of determinants: against integer arithmetic, at the limits of the range of doubles, and
// consistency of ties broken by ids.
#include <check.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "predicates/plane.hpp"
#include "run_suite.hpp"

using pnpbs::in_circle;
using pnpbs::in_circle_perturbed;
using pnpbs::orientation;
using P = pnpbs::Point<2>;

namespace {

__extension__ using Wide = __int128;

struct Lattice {
  std::int64_t x, y;
};

P scaled_point(const Lattice& p, int exponent) {
  return {std::ldexp(static_cast<double>(p.x), exponent),
          std::ldexp(static_cast<double>(p.y), exponent)};
}

int sign(Wide value) { return (value > 0) - (value < 0); }

Wide cross(const Lattice& a, const Lattice& b, const Lattice& c) {
  return Wide(a.x - c.x) * (b.y - c.y) - Wide(a.y - c.y) * (b.x - c.x);
}

Wide circle(const Lattice& a, const Lattice& b, const Lattice& c, const Lattice& d) {
  const auto lift = [&](const Lattice& p) {
    return Wide(p.x - d.x) * (p.x - d.x) + Wide(p.y - d.y) * (p.y - d.y);
  };
  return lift(a) * cross(b, c, d) + lift(b) * cross(c, a, d) + lift(c) * cross(a, b, d);
}

Lattice random_lattice(std::mt19937_64& random, std::int64_t range) {
  std::uniform_int_distribution<std::int64_t> any(-range, range);
  return {any(random), any(random)};
}

void compare_orientation(std::int64_t range, int exponent, int count) {
  std::mt19937_64 random(1);
  for (int i = 0; i < count; ++i) {
    const Lattice a = random_lattice(random, range), b = random_lattice(random, range);
    const Lattice c = random_lattice(random, range);
    ck_assert_int_eq(orientation(scaled_point(a, exponent), scaled_point(b, exponent),
                                 scaled_point(c, exponent)),
                     sign(cross(a, b, c)));
  }
}

void compare_in_circle(std::int64_t range, int exponent, int count) {
  std::mt19937_64 random(2);
  for (int i = 0; i < count; ++i) {
    const Lattice a = random_lattice(random, range), b = random_lattice(random, range);
    const Lattice c = random_lattice(random, range), d = random_lattice(random, range);
    ck_assert_int_eq(in_circle(scaled_point(a, exponent), scaled_point(b, exponent),
                               scaled_point(c, exponent), scaled_point(d, exponent)),
                     sign(circle(a, b, c, d)));
  }
}

Wide turn_of(const Lattice& a, const Lattice& b, const Lattice& c, const Lattice& d) {
  return Wide(b.x - a.x) * (d.y - c.y) - Wide(b.y - a.y) * (d.x - c.x);
}

// Every second pair of directions is parallel, or almost parallel by one unit.
void compare_turn(std::int64_t range, int exponent, int count) {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<std::int64_t> factor(-2, 2), unit(-1, 1);
  for (int i = 0; i < count; ++i) {
    const Lattice a = random_lattice(random, range), b = random_lattice(random, range);
    const Lattice c = random_lattice(random, range);
    Lattice d = random_lattice(random, range);
    if (i % 2 == 0) {
      const std::int64_t times = factor(random);
      d = {c.x + times * (b.x - a.x) + unit(random), c.y + times * (b.y - a.y)};
    }
    const int expected = sign(turn_of(a, b, c, d));
    ck_assert_int_eq(pnpbs::turn(scaled_point(a, exponent), scaled_point(b, exponent),
                                 scaled_point(c, exponent), scaled_point(d, exponent)),
                     expected);
  }
}

struct Set {
  std::vector<P> points;
  std::vector<std::int64_t> ids;
};

Set grid(int side) {
  Set set;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) set.points.push_back({double(x), double(y)});
  }
  return set;
}

Set twelve_on_a_circle() {
  Set set;
  set.points = {{5, 0},  {4, 3},   {3, 4},   {0, 5},  {-3, 4}, {-4, 3},
                {-5, 0}, {-4, -3}, {-3, -4}, {0, -5}, {3, -4}, {4, -3}};
  return set;
}

void shuffle_ids(Set& set, unsigned seed) {
  set.ids.resize(set.points.size());
  std::iota(set.ids.begin(), set.ids.end(), std::int64_t{7});
  std::shuffle(set.ids.begin(), set.ids.end(), std::mt19937(seed));
}

bool is_delaunay(const Set& set, std::size_t i, std::size_t j, std::size_t k) {
  const auto& p = set.points;
  if (orientation(p[i], p[j], p[k]) <= 0) return false;
  for (std::size_t l = 0; l < p.size(); ++l) {
    if (l == i || l == j || l == k) continue;
    const int side =
        in_circle_perturbed(p[i], p[j], p[k], p[l], set.ids[i], set.ids[j], set.ids[k], set.ids[l]);
    ck_assert_int_ne(side, 0);
    if (side > 0) return false;
  }
  return true;
}

// Returns twice the area and the number of the triangles whose circumcircles are empty.
std::pair<double, int> empty_circles(const Set& set) {
  double area = 0;
  int count = 0;
  const auto& p = set.points;
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = i + 1; j < p.size(); ++j) {
      for (std::size_t k = i + 1; k < p.size(); ++k) {
        if (k == j || !is_delaunay(set, i, j, k)) continue;
        ++count;
        area +=
            (p[j][0] - p[i][0]) * (p[k][1] - p[i][1]) - (p[j][1] - p[i][1]) * (p[k][0] - p[i][0]);
      }
    }
  }
  return {area, count};
}

}  // namespace

START_TEST(orientation_equals_integer_arithmetic) {
  for (const int exponent : {0, -30, 100, -200, 400, 900, -1000}) {
    compare_orientation(3, exponent, 2000);
    compare_orientation(1 << 20, exponent, 2000);
    compare_orientation(std::int64_t{1} << 53, exponent, 2000);
  }
  compare_orientation(1000, -1074, 2000);
  compare_orientation(1000, 1013, 2000);
}
END_TEST

START_TEST(turn_equals_integer_arithmetic) {
  for (const int exponent : {0, -30, 100, -200, 400, 900, -1000}) {
    compare_turn(3, exponent, 2000);
    compare_turn(1 << 20, exponent, 2000);
    compare_turn(std::int64_t{1} << 50, exponent, 2000);
  }
  compare_turn(1000, -1074, 2000);
  compare_turn(200, 1013, 2000);
  // Bits too far apart for expansions.
  ck_assert_int_eq(pnpbs::turn({1, 1}, {1e300, 1e300}, {0, 0}, {1e-300, 1e-300}), 0);
  ck_assert_int_eq(
      pnpbs::turn({1, 1}, {1e300, 1e300}, {0, 0}, {1e-300, std::nextafter(1e-300, 1.0)}), 1);
}
END_TEST

START_TEST(orientation_next_to_a_line) {
  const double ulp = std::ldexp(1.0, -53);
  for (int i = 0; i < 64; ++i) {
    for (int j = 0; j < 64; ++j) {
      const P a{0.5 + i * ulp, 0.5 + j * ulp};
      ck_assert_int_eq(orientation(a, {12, 12}, {24, 24}), (j > i) - (j < i));
    }
  }
}
END_TEST

START_TEST(in_circle_equals_integer_arithmetic) {
  for (const int exponent : {0, -30, 100, -200, 400, 900, -1000}) {
    compare_in_circle(3, exponent, 2000);
    compare_in_circle(1 << 10, exponent, 2000);
    compare_in_circle(1 << 28, exponent, 2000);
  }
  compare_in_circle(4, -1074, 2000);
  compare_in_circle(1000, -1074, 2000);
  compare_in_circle(1000, 1013, 2000);
}
END_TEST

START_TEST(differences_that_round_stay_exact) {
  // Together with 2^-60, 1 - 2^-60 is not a double.
  const double tiny = std::ldexp(1.0, -60);
  const P c{1, tiny};
  ck_assert_int_eq(orientation({0, 0}, {1, 0}, {tiny, tiny}), 1);
  ck_assert_int_eq(orientation({tiny, tiny}, {1, 1}, {3, 3}), 0);
  ck_assert_int_eq(orientation({tiny, 2 * tiny}, {1, 1}, {3, 3}), 1);
  // The unit circle about (0, 1), with its lowest point moved by tiny along x and along y.
  ck_assert_int_eq(in_circle({1, 1}, {0, 2}, {-1, 1}, {0, 0}), 0);
  ck_assert_int_eq(in_circle({1, 1}, {0, 2}, {-1, 1}, {tiny, 0}), -1);
  ck_assert_int_eq(in_circle({1, 1}, {0, 2}, {-1, 1}, {0, tiny}), 1);
  ck_assert_int_eq(in_circle({1, 1}, {0, 2}, {-1, 1}, {0, -tiny}), -1);
  ck_assert_int_eq(orientation(c, c, {0, 0}), 0);
}
END_TEST

START_TEST(exponents_far_apart) {
  const double max = std::numeric_limits<double>::max();
  const double min = std::numeric_limits<double>::denorm_min();
  ck_assert_int_eq(orientation({-max, -max}, {0, 0}, {max, max}), 0);
  ck_assert_int_eq(orientation({-max, -max}, {0, -min}, {max, max}),
                   -orientation({-max, -max}, {0, min}, {max, max}));
  ck_assert_int_eq(orientation({-max, -max}, {0, -min}, {max, max}), 1);
  ck_assert_int_eq(orientation({0, 0}, {1, 1e-300}, {2, 2e-300}), 0);
  ck_assert_int_eq(orientation({0, 0}, {1, 1e-300}, {2, std::nextafter(2e-300, 1.0)}), 1);
  ck_assert_int_eq(in_circle({1, 0}, {0, 1}, {-1, 0}, {0, -1}), 0);
  ck_assert_int_eq(in_circle({1, 0}, {0, 1}, {-1, 0}, {1e-300, -1}), -1);
  ck_assert_int_eq(in_circle({max, 0}, {0, max}, {-max, 0}, {0, -max}), 0);
  ck_assert_int_eq(in_circle({max, 0}, {0, max}, {-max, 0}, {min, -max}), -1);
  ck_assert_int_eq(in_circle({max, 0}, {0, max}, {-max, 0}, {0, min}), 1);
  ck_assert_int_eq(in_circle({min, 0}, {0, min}, {-min, 0}, {0, 0}), 1);
  ck_assert_int_eq(in_circle({1e150, 0}, {1e-170, 1e-170}, {-1e-170, 1e-170}, {0, 0}),
                   -in_circle({1e-170, 1e-170}, {1e150, 0}, {-1e-170, 1e-170}, {0, 0}));
}
END_TEST

START_TEST(perturbation_is_antisymmetric) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 3000; ++trial) {
    std::array<P, 4> p;
    std::array<std::int64_t, 4> id{4, 8, 15, 16};
    for (P& point : p) point = scaled_point(random_lattice(random, 2), 0);
    std::shuffle(id.begin(), id.end(), random);
    const auto sign_of = [&](const std::array<int, 4>& o) {
      return in_circle_perturbed(p[o[0]], p[o[1]], p[o[2]], p[o[3]], id[o[0]], id[o[1]], id[o[2]],
                                 id[o[3]]);
    };
    std::array<int, 4> order{0, 1, 2, 3};
    const int first = sign_of(order);
    bool on_a_line = true;
    for (int leave = 0; leave < 4; ++leave) {
      on_a_line =
          on_a_line && orientation(p[(leave + 1) % 4], p[(leave + 2) % 4], p[(leave + 3) % 4]) == 0;
    }
    if (!on_a_line) ck_assert_int_ne(first, 0);
    do {
      int inversions = 0;
      for (int i = 0; i < 4; ++i) {
        for (int j = i + 1; j < 4; ++j) inversions += order[i] > order[j];
      }
      ck_assert_int_eq(sign_of(order), inversions % 2 == 0 ? first : -first);
    } while (std::next_permutation(order.begin(), order.end()));
  }
}
END_TEST

START_TEST(square_gets_one_diagonal) {
  const P a{0, 0}, b{1, 0}, c{1, 1}, d{0, 1};
  std::array<std::int64_t, 4> id{0, 1, 2, 3};
  do {
    const int ac = in_circle_perturbed(a, b, c, d, id[0], id[1], id[2], id[3]);
    const int ac_from_d = in_circle_perturbed(a, c, d, b, id[0], id[2], id[3], id[1]);
    const int bd = in_circle_perturbed(a, b, d, c, id[0], id[1], id[3], id[2]);
    const int bd_from_c = in_circle_perturbed(b, c, d, a, id[1], id[2], id[3], id[0]);
    ck_assert_int_eq(ac, ac_from_d);
    ck_assert_int_eq(bd, bd_from_c);
    ck_assert_int_eq(ac, -bd);
    // The smallest id is lifted most and is therefore outside: the diagonal joins its neighbours.
    const auto smallest = std::min_element(id.begin(), id.end()) - id.begin();
    ck_assert_int_eq(bd, smallest % 2 == 0 ? -1 : 1);
  } while (std::next_permutation(id.begin(), id.end()));
}
END_TEST

START_TEST(ties_make_one_triangulation) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Set set = grid(5);
    shuffle_ids(set, seed);
    const auto [grid_area, grid_count] = empty_circles(set);
    ck_assert_int_eq(grid_count, 32);
    ck_assert_double_eq(grid_area, 32);
    set = twelve_on_a_circle();
    shuffle_ids(set, seed);
    const auto [polygon_area, polygon_count] = empty_circles(set);
    ck_assert_int_eq(polygon_count, 10);
    ck_assert_double_eq(polygon_area, 4 * 15 + 4 * 7 + 4 * 15);
  }
}
END_TEST

START_TEST(crossing_is_proper) {
  using pnpbs::cross_properly;
  ck_assert(cross_properly({0, 0}, {2, 2}, {0, 2}, {2, 0}));
  ck_assert(!cross_properly({0, 0}, {2, 2}, {2, 2}, {3, 0}));
  ck_assert(!cross_properly({0, 0}, {2, 2}, {1, 1}, {3, 0}));
  ck_assert(!cross_properly({0, 0}, {2, 2}, {1, 1}, {3, 3}));
  ck_assert(!cross_properly({0, 0}, {2, 2}, {5, 0}, {6, 1}));
}
END_TEST

TEST_SUITE(test_predicates) {
  return run_suite(
      "predicates",
      {orientation_equals_integer_arithmetic, turn_equals_integer_arithmetic,
       orientation_next_to_a_line, in_circle_equals_integer_arithmetic,
       differences_that_round_stay_exact, exponents_far_apart, perturbation_is_antisymmetric,
       square_gets_one_diagonal, ties_make_one_triangulation, crossing_is_proper});
}
