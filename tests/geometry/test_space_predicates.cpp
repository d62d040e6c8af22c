// SPDX-License-Identifier: BSD-3-Clause
// Signs of determinants in space against exact integers: for random points, near a plane or a
// sphere, exactly on them, and at the limits of the range of doubles.
#include <check.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "core/random.hpp"
#include "predicates/space.hpp"
#include "run_suite.hpp"
#include "space_reference.hpp"

using pnpbs::in_sphere;
using pnpbs::orientation;
using P = pnpbs::Point<3>;

namespace {

using Whole = std::array<std::int64_t, 3>;

constexpr pnpbs::Box<3> kUnitCube{{0, 0, 0}, {1, 1, 1}};

P scaled_point(const Whole& x, int exponent) {
  P point;
  for (int k = 0; k < 3; ++k) point[k] = std::ldexp(static_cast<double>(x[k]), exponent);
  return point;
}

Whole random_lattice(Random& random, std::int64_t range) {
  Whole x;
  for (auto& coordinate : x) coordinate = random.below(2 * range + 1) - range;
  return x;
}

template <class Items>
auto any_of(Random& random, const Items& items) {
  return items[random.below(static_cast<std::int64_t>(std::size(items)))];
}

// Numbers of exact ties: four points in a plane, five on a sphere.
struct Zeros {
  int plane = 0, sphere = 0;
};

// Compares `count` sets of five points from `make`. Tests the exact arithmetic also where the
// filter decides.
template <class Make>
Zeros compare(int count, const Make& make) {
  Random random(1);
  Zeros zeros;
  for (int i = 0; i < count; ++i) {
    const FivePoints p = make(random);
    const SpaceSigns expected = space_signs(p);
    const int plane = orientation(p[0], p[1], p[2], p[3]);
    const int sphere = in_sphere(p[0], p[1], p[2], p[3], p[4]);
    quick_assert_msg(plane == expected.rest[4], "orientation of five points %d", i);
    quick_assert_msg(sphere == expected.sphere, "sphere of five points %d", i);
    const int exact_plane = pnpbs::predicates::orientation_exact(p[0], p[1], p[2], p[3]);
    const int exact_sphere = pnpbs::predicates::in_sphere_exact(p[0], p[1], p[2], p[3], p[4]);
    quick_assert_msg(exact_plane == plane, "exact orientation of five points %d", i);
    quick_assert_msg(exact_sphere == sphere, "exact sphere of five points %d", i);
    zeros.plane += plane == 0;
    zeros.sphere += sphere == 0;
  }
  return zeros;
}

// Compares integer points from `make`, scaled by one of the powers of two. In every tenth set, one
// coordinate is changed by 1.
template <class Make>
Zeros compare_scaled(int count, const std::vector<int>& exponents, const Make& make) {
  return compare(count, [&](Random& random) {
    std::array<Whole, 5> whole = make(random);
    if (random.below(10) == 0) ++whole[random.below(5)][random.below(3)];
    const int exponent = any_of(random, exponents);
    FivePoints points;
    for (int i = 0; i < 5; ++i) points[i] = scaled_point(whole[i], exponent);
    return points;
  });
}

// Returns the integer points with x^2 + y^2 + z^2 = square.
std::vector<Whole> lattice_sphere(std::int64_t square) {
  std::vector<Whole> found;
  const auto max = static_cast<std::int64_t>(std::sqrt(static_cast<double>(square)));
  for (std::int64_t x = -max; x <= max; ++x) {
    for (std::int64_t y = -max; y <= max; ++y) {
      for (std::int64_t z = -max; z <= max; ++z) {
        if (x * x + y * y + z * z == square) found.push_back({x, y, z});
      }
    }
  }
  return found;
}

P random_direction(Random& random) {
  for (;;) {
    const P x = random.point<3>({{-1, -1, -1}, {1, 1, 1}});
    const double length = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    if (length > 0.1 && length < 1) return {x[0] / length, x[1] / length, x[2] / length};
  }
}

double any_double(Random& random) {
  for (;;) {
    auto bits = static_cast<std::uint64_t>(random.below(std::int64_t{1} << 32)) << 32;
    bits |= static_cast<std::uint64_t>(random.below(std::int64_t{1} << 32));
    const auto value = std::bit_cast<double>(bits);
    if (std::isfinite(value)) return value;
  }
}

}  // namespace

START_TEST(signs_are_as_documented) {
  const P o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  ck_assert_int_eq(orientation(o, x, y, z), 1);
  ck_assert_int_eq(orientation(o, y, x, z), -1);
  ck_assert_int_eq(orientation(o, x, y, {0, 0, -1}), -1);
  ck_assert_int_eq(orientation(o, x, y, {5, 7, 0}), 0);
  ck_assert_int_eq(in_sphere(o, x, y, z, {0.5, 0.5, 0.5}), 1);
  ck_assert_int_eq(in_sphere(o, x, y, z, {2, 2, 2}), -1);
  ck_assert_int_eq(in_sphere(o, x, y, z, {1, 1, 1}), 0);
  ck_assert_int_eq(in_sphere(o, y, x, z, {0.5, 0.5, 0.5}), -1);
}
END_TEST

START_TEST(anywhere) {
  compare(400000, [](Random& random) {
    FivePoints points;
    for (P& x : points) x = random.point<3>(kUnitCube);
    return points;
  });
}
END_TEST

START_TEST(near_each_other) {
  compare(300000, [](Random& random) {
    const P middle = random.point<3>({{-8, -8, -8}, {8, 8, 8}});
    const double size = std::ldexp(1.0, -static_cast<int>(random.below(53)));
    FivePoints points;
    for (P& x : points) {
      x = random.point<3>(kUnitCube);
      for (int k = 0; k < 3; ++k) x[k] = middle[k] + size * x[k];
    }
    return points;
  });
}
END_TEST

START_TEST(near_a_sphere) {
  compare(200000, [](Random& random) {
    const P middle = random.point<3>(kUnitCube);
    const double radius = random.between(0, 1);
    FivePoints points;
    for (P& x : points) {
      x = random_direction(random);
      for (int k = 0; k < 3; ++k) x[k] = middle[k] + radius * x[k];
    }
    return points;
  });
}
END_TEST

START_TEST(near_a_plane) {
  compare(100000, [](Random& random) {
    const P slope = random.point<3>({{-2, -2, -2}, {2, 2, 2}});
    FivePoints points;
    for (P& x : points) {
      x = random.point<3>(kUnitCube);
      x[2] = slope[0] * x[0] + slope[1] * x[1] + slope[2];
    }
    return points;
  });
}
END_TEST

// Exponents include the limits of the range for products of 2 to 5 differences.
START_TEST(small_lattice) {
  const std::vector<int> exponents{0,    -30,  100,  900,  -1000, -1074, 1020, -535, -536,
                                   -537, -538, -357, -358, -359,  -360,  -361, -213, -214,
                                   -215, -216, -217, 203,  204,   205,   340,  341,  511};
  const Zeros zeros = compare_scaled(40000, exponents, [](Random& random) {
    std::array<Whole, 5> whole;
    const std::int64_t range = 1 + random.below(3);
    for (Whole& x : whole) x = random_lattice(random, range);
    return whole;
  });
  ck_assert_int_gt(zeros.plane, 4000);
  ck_assert_int_gt(zeros.sphere, 4000);
  compare_scaled(5000, {-1074, 1013, -360, -216}, [](Random& random) {
    std::array<Whole, 5> whole;
    for (Whole& x : whole) x = random_lattice(random, 1000);
    return whole;
  });
}
END_TEST

START_TEST(lattice_far_from_the_origin) {
  const Zeros zeros = compare_scaled(10000, {0, -50, 300, -1000}, [](Random& random) {
    const Whole origin = random_lattice(random, std::int64_t{1} << 52);
    std::array<Whole, 5> whole;
    for (Whole& x : whole) {
      x = random_lattice(random, 2);
      for (int k = 0; k < 3; ++k) x[k] += origin[k];
    }
    return whole;
  });
  ck_assert_int_gt(zeros.plane, 500);
  ck_assert_int_gt(zeros.sphere, 500);
}
END_TEST

START_TEST(multiples_of_a_tenth) {
  const Zeros zeros = compare(10000, [](Random& random) {
    FivePoints points;
    for (P& x : points) {
      for (double& coordinate : x) coordinate = static_cast<double>(random.below(8)) * 0.1;
    }
    return points;
  });
  ck_assert_int_gt(zeros.plane, 100);
}
END_TEST

START_TEST(exactly_in_a_plane) {
  const Zeros zeros = compare_scaled(20000, {0, -45, 400, -1000}, [](Random& random) {
    const std::int64_t range = std::int64_t{1} << (5 + random.below(20));
    const Whole origin = random_lattice(random, std::int64_t{1} << (10 + random.below(40)));
    const Whole u = random_lattice(random, range), v = random_lattice(random, range);
    std::array<Whole, 5> whole;
    for (Whole& x : whole) {
      const std::int64_t i = random.below(1 << 12), j = random.below(1 << 12);
      for (int k = 0; k < 3; ++k) x[k] = origin[k] + i * u[k] + j * v[k];
    }
    return whole;
  });
  ck_assert_int_gt(zeros.plane, 15000);
}
END_TEST

START_TEST(exactly_on_a_sphere) {
  const std::vector<std::vector<Whole>> spheres{lattice_sphere(3), lattice_sphere(9),
                                                lattice_sphere(1105), lattice_sphere(7 * 7 * 81)};
  const Zeros zeros = compare_scaled(30000, {0, -45, 150, -200, 900, -1000}, [&](Random& random) {
    const Whole middle = random_lattice(random, std::int64_t{1} << (1 + random.below(51)));
    const std::int64_t times = std::int64_t{1} + random.below(1 << random.below(30));
    const std::vector<Whole>& sphere = any_of(random, spheres);
    std::array<Whole, 5> whole;
    for (Whole& x : whole) {
      x = any_of(random, sphere);
      for (int k = 0; k < 3; ++k) x[k] = middle[k] + times * x[k];
    }
    return whole;
  });
  ck_assert_int_gt(zeros.sphere, 20000);
}
END_TEST

// Differences of 18 to 130 bits in determinants of maximum size: the corners of a cube (in every
// other case of a regular tetrahedron) about a point next to its centre.
START_TEST(as_many_bits_as_fit) {
  compare(20000, [](Random& random) {
    const int bits = 18 + static_cast<int>(random.below(113));
    const double max = std::ldexp(1.0, bits) - std::ldexp(1.0, std::max(bits - 53, 0));
    std::vector<Whole> corners{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    random.shuffle(corners);
    const bool regular = random.below(2) == 0;
    FivePoints points;
    for (int i = 0; i < 5; ++i) {
      const Whole middle = random_lattice(random, 1);
      for (int k = 0; k < 3; ++k) {
        const auto side = regular && i < 4 ? corners[i][k] : 2 * random.below(2) - 1;
        points[i][k] = i < 4 ? static_cast<double>(side) * max : static_cast<double>(middle[k]);
      }
    }
    return points;
  });
}
END_TEST

// Products of two small coordinates lose bits, which a large third coordinate makes significant.
START_TEST(axes_of_different_units) {
  const Zeros zeros = compare(5000, [](Random& random) {
    const auto exponent = [&random](int low, int high) {
      return low + static_cast<int>(random.below(high - low + 1));
    };
    const int first = exponent(-1000, -70);
    std::vector<int> units{first, exponent(-1080, -1070) - first, exponent(-300, 340)};
    if (random.below(4) == 0) units = {exponent(-1074, 1000), exponent(-1074, 1000), 0};
    random.shuffle(units);
    FivePoints points;
    for (P& x : points) {
      const Whole whole = random_lattice(random, 3);
      for (int k = 0; k < 3; ++k) x[k] = std::ldexp(static_cast<double>(whole[k]), units[k]);
    }
    return points;
  });
  ck_assert_int_gt(zeros.sphere, 100);
}
END_TEST

// The corners of boxes lie on a sphere for any ratio of their edges.
START_TEST(boxes_of_any_edges) {
  const Zeros zeros = compare(3000, [](Random& random) {
    const double width = any_double(random), depth = any_double(random);
    const double height = random.below(4) == 0 ? 0x1p-1074 : any_double(random);
    FivePoints points;
    for (P& x : points) {
      x = {random.below(2) ? width : -width, random.below(2) ? depth : -depth,
           random.below(2) ? height : -height};
    }
    if (random.below(3) == 0) {
      double& changed = points[random.below(5)][random.below(3)];
      changed = std::nextafter(changed, 0);
    }
    return points;
  });
  ck_assert_int_gt(zeros.sphere, 1500);
}
END_TEST

START_TEST(any_finite_numbers) {
  compare(1500, [](Random& random) {
    FivePoints points;
    for (P& x : points) x = {any_double(random), any_double(random), any_double(random)};
    return points;
  });
}
END_TEST

START_TEST(differences_that_round_stay_exact) {
  const double tiny = std::ldexp(1.0, -60);
  const P x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, below{0, 0, -1};
  ck_assert_int_eq(orientation(x, y, z, {0.5, 0.5, tiny}), 1);
  ck_assert_int_eq(orientation(x, y, z, {0.5, 0.5, -tiny}), -1);
  ck_assert_int_eq(in_sphere(x, y, z, {-1, 0, 0}, below), 0);
  ck_assert_int_eq(in_sphere(x, y, z, {-1, 0, 0}, {tiny, 0, -1}),
                   -orientation(x, y, z, {-1, 0, 0}));
}
END_TEST

START_TEST(exponents_far_apart) {
  const double max = std::numeric_limits<double>::max();
  const double min = std::numeric_limits<double>::denorm_min();
  const P a{-max, -max, 0}, b{max, -max, 0}, c{0, max, 0};
  ck_assert_int_eq(orientation(a, b, c, {0, 0, 0}), 0);
  ck_assert_int_eq(orientation(a, b, c, {max, max, min}), 1);
  ck_assert_int_eq(orientation(a, b, c, {max, -max, -min}), -1);
  const P x{max, 0, 0}, y{0, max, 0}, z{0, 0, max};
  const int turn = orientation(x, y, z, {-max, 0, 0});
  ck_assert_int_eq(in_sphere(x, y, z, {-max, 0, 0}, {0, -max, 0}), 0);
  ck_assert_int_eq(in_sphere(x, y, z, {-max, 0, 0}, {min, -max, 0}), -turn);
  ck_assert_int_eq(in_sphere(x, y, z, {-max, 0, 0}, {0, 0, min}), turn);
}
END_TEST

TEST_SUITE(test_space_predicates) {
  return run_suite(
      "space predicates",
      {signs_are_as_documented, anywhere, near_each_other, near_a_sphere, near_a_plane,
       small_lattice, lattice_far_from_the_origin, multiples_of_a_tenth, exactly_in_a_plane,
       exactly_on_a_sphere, as_many_bits_as_fit, axes_of_different_units, boxes_of_any_edges,
       any_finite_numbers, differences_that_round_stay_exact, exponents_far_apart});
}
