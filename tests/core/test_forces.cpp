// SPDX-License-Identifier: BSD-3-Clause
// Pair laws, resultant forces and overlap ratios, against formulas and direct sums over all pairs.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

#include "bubbles.hpp"
#include "dynamics/bubble_force.hpp"
#include "dynamics/pair_laws.hpp"
#include "population/population_thresholds.hpp"
#include "run_kernel_suite.hpp"

using pnpbs::BlockVector;
using pnpbs::CubicLaw;
using pnpbs::LinearPush;

namespace {

template <int Dim>
using Vectors = std::vector<std::array<double, Dim>>;

// Returns the forces on all nodes in the order of memory.
template <int Dim, class Law>
Vectors<Dim> block_forces(const Bubbles<Dim>& b, const Law& law) {
  Vectors<Dim> forces(static_cast<std::size_t>(b.nodes.count));
  for (std::int64_t block = 0; block < b.lists.block_count(); ++block) {
    std::int64_t self[pnpbs::kLanes];
    pnpbs::block_nodes(block, b.nodes.count, self);
    BlockVector<Dim> force;
    pnpbs::block_force<Dim>(b.lists.block(block), law, pnpbs::positions_of<Dim>(b.nodes.x),
                            b.nodes.d.data(), self, force);
    for (std::size_t lane = 0; lane < pnpbs::kLanes; ++lane)
      if (self[lane] < b.nodes.count)
        for (int k = 0; k < Dim; ++k)
          forces[static_cast<std::size_t>(self[lane])][static_cast<std::size_t>(k)] =
              force[static_cast<std::size_t>(k)][lane];
  }
  return forces;
}

// An independent form of equation (2) of the paper and of the linear push.
double cubic(double w) { return w > 1.5 ? 0 : 1.25 * w * w * w - 2.375 * w * w + 1.125; }
double push(double w) { return w > 1.06 ? 0 : 1 - w / 1.06; }
// Integrals of these from w to the range.
double cubic_energy(double w) {
  const auto primitive = [](double s) {
    return 1.25 / 4 * s * s * s * s - 2.375 / 3 * s * s * s + 1.125 * s;
  };
  return w > 1.5 ? 0 : primitive(1.5) - primitive(w);
}
double push_energy(double w) { return w > 1.06 ? 0 : (1.06 - w) * (1.06 - w) / (2 * 1.06); }

template <int Dim>
struct DirectForce {
  std::array<double, Dim> sum{};
  double magnitudes = 0;
};

// Returns the factor of a pair's force besides f(w).
template <int Dim>
double factor(const CubicLaw&, double) {
  return 1;
}
template <int Dim>
double factor(const LinearPush&, double desired) {
  return Dim == 2 ? desired : desired * desired;
}

template <int Dim, class Law>
DirectForce<Dim> direct_force(const std::vector<Bubble<Dim>>& all, std::size_t i, const Law& of,
                              double (*law)(double)) {
  DirectForce<Dim> force;
  for (std::size_t j = 0; j < all.size(); ++j) {
    if (j == i) continue;
    const double gap = pnpbs::distance<Dim>(all[i].x, all[j].x);
    const double desired = 0.5 * (all[i].d + all[j].d);
    const double f = factor<Dim>(of, desired) * law(gap / desired);
    for (std::size_t k = 0; k < Dim; ++k) force.sum[k] += f * (all[i].x[k] - all[j].x[k]) / gap;
    force.magnitudes += std::fabs(f);
  }
  return force;
}

template <int Dim>
double graded(const Point<Dim>& x) {
  return 0.04 + 0.1 * x[0];
}

template <int Dim>
Bubbles<Dim> random_set(std::uint64_t seed, std::int64_t n, double radius = 1.7) {
  Random random(seed);
  Bubbles<Dim> b;
  b.grow_tree(graded<Dim>);
  b.set(random_bubbles<Dim>(random, n, graded<Dim>));
  b.list(radius);
  return b;
}

template <int Dim, class Law>
void expect_direct_sum(const Law& law, double (*formula)(double), std::int64_t n) {
  const Bubbles<Dim> b = random_set<Dim>(31, n);
  const Vectors<Dim> forces = block_forces<Dim>(b, law);
  const std::vector<Bubble<Dim>> all = b.bubbles();
  double strongest = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const DirectForce<Dim> direct = direct_force<Dim>(all, i, law, formula);
    for (std::size_t k = 0; k < Dim; ++k)
      ck_assert_double_eq_tol(forces[i][k], direct.sum[k], 1e-13 * (1 + direct.magnitudes));
    strongest = std::max(strongest, direct.magnitudes);
  }
  ck_assert_double_gt(strongest, factor<Dim>(law, 0.14));  // there were forces to add
}

// Compares the forces with minus the gradient of the energy of all pairs, by central differences.
template <int Dim, class Law>
void expect_gradient(const Law& law, double (*energy)(double)) {
  const Bubbles<Dim> b = random_set<Dim>(32, 300);
  const Vectors<Dim> forces = block_forces<Dim>(b, law);
  const std::vector<Bubble<Dim>> all = b.bubbles();
  constexpr double kStep = 1e-6;
  for (std::size_t i = 0; i < all.size(); i += 7) {
    const auto energy_at = [&](const Point<Dim>& x) {
      double sum = 0;
      for (std::size_t j = 0; j < all.size(); ++j) {
        const double desired = 0.5 * (all[i].d + all[j].d);
        if (j != i)
          sum += factor<Dim>(law, desired) * desired *
                 energy(pnpbs::distance<Dim>(x, all[j].x) / desired);
      }
      return sum;
    };
    for (std::size_t k = 0; k < Dim; ++k) {
      Point<Dim> ahead = all[i].x, behind = all[i].x;
      ahead[k] += kStep;
      behind[k] -= kStep;
      const double slope = (energy_at(ahead) - energy_at(behind)) / (2 * kStep);
      ck_assert_double_eq_tol(forces[i][k], -slope, 2e-5);
    }
  }
}

template <int Dim>
void expect_direct_ratio() {
  const Bubbles<Dim> b = random_set<Dim>(33, 900);
  const std::vector<Bubble<Dim>> all = b.bubbles();
  for (std::size_t i = 0; i < all.size(); ++i) {
    double sum = 0;
    const double r = all[i].d / 2;
    for (std::size_t j = 0; j < all.size(); ++j)
      if (j != i)
        sum += std::max(0.0, 2 * r + all[j].d / 2 - pnpbs::distance<Dim>(all[i].x, all[j].x));
    ck_assert_double_eq_tol(
        pnpbs::overlap_ratio<Dim>(b.nodes, b.lists, static_cast<std::int64_t>(i)), sum / r,
        1e-12 * (1 + sum / r));
  }
}

// Returns the overlap ratio of the node nearest to the centre of the box.
template <int Dim>
double ratio_in_the_middle(Bubbles<Dim>& b, const std::vector<Point<Dim>>& points, double d) {
  std::vector<Bubble<Dim>> bubbles;
  for (const Point<Dim>& x : points)
    bubbles.push_back({x, d, static_cast<std::int64_t>(bubbles.size())});
  b.grow_tree([d](const Point<Dim>&) { return d; });
  b.set(bubbles);
  b.list(1.7);
  Point<Dim> middle;
  middle.fill(0.5);
  std::int64_t nearest = 0;
  for (std::int64_t i = 1; i < b.nodes.count; ++i)
    if (pnpbs::distance<Dim>(b.nodes.position(i), middle) <
        pnpbs::distance<Dim>(b.nodes.position(nearest), middle))
      nearest = i;
  return pnpbs::overlap_ratio<Dim>(b.nodes, b.lists, nearest);
}

// Returns copies of a cell's points throughout the unit cube.
std::vector<Point<3>> crystal(double cell, const std::vector<Point<3>>& basis) {
  std::vector<Point<3>> points;
  for (int i = 0; i * cell < 1; ++i)
    for (int j = 0; j * cell < 1; ++j)
      for (int k = 0; k * cell < 1; ++k)
        for (const Point<3>& p : basis)
          points.push_back({cell * (i + p[0]), cell * (j + p[1]), cell * (k + p[2])});
  return points;
}

}  // namespace

START_TEST(cubic_law) {
  for (const double k0 : {1.0, 2.5}) {
    const CubicLaw law{k0};
    ck_assert_double_eq(law(0), 1.125 * k0);
    ck_assert_double_eq_tol(law(1), 0, 1e-15 * k0);
    ck_assert_double_eq_tol(law(1.5), 0, 1e-15 * k0);
    const double h = 1e-5;
    ck_assert_double_eq_tol((law(1 + h) - law(1 - h)) / (2 * h), -k0, 1e-8 * k0);
    double min = 1, where = 0;
    for (int step = 0; step <= 15000; ++step) {
      const double w = step * 1e-4;
      ck_assert_double_eq_tol(law(w), k0 * cubic(w), 1e-14 * k0);
      if (law(w) < min) {
        min = law(w);
        where = w;
      }
    }
    ck_assert_double_eq_tol(where, 1.267, 1e-3);
    ck_assert_double_eq_tol(min, -0.145 * k0, 5e-4 * k0);
    for (const double w : {std::nextafter(1.5, 2.0), 1.6, 3.0, 1e100, 1e200})
      quick_assert(law(w) == 0);
  }
}
END_TEST

START_TEST(linear_push) {
  for (const double range : {1.0, 1.06, 4.0}) {
    const LinearPush law{3, range};
    ck_assert_double_eq(law(0), 3);
    for (int step = 0; step <= 1000; ++step) {
      const double w = range * step * 1e-3;
      ck_assert_double_eq_tol(law(w), 3 * (1 - w / range), 1e-14);
      ck_assert_double_ge(law(w), 0);
    }
    for (const double w : {range, std::nextafter(range, 10.0), 1.5 * range, 1e100, 1e200})
      quick_assert(law(w) == 0);
  }
}
END_TEST

START_TEST(forces_are_the_direct_sum) {
  expect_direct_sum<2>(CubicLaw{}, cubic, 900);
  expect_direct_sum<3>(CubicLaw{}, cubic, 900);
  expect_direct_sum<2>(LinearPush{}, push, 900);
  expect_direct_sum<3>(LinearPush{}, push, 900);
}
END_TEST

START_TEST(forces_are_the_gradient_of_an_energy) {
  expect_gradient<2>(CubicLaw{}, cubic_energy);
  expect_gradient<3>(CubicLaw{}, cubic_energy);
  expect_gradient<2>(LinearPush{}, push_energy);
  expect_gradient<3>(LinearPush{}, push_energy);
}
END_TEST

// Forces by id are equal to the bit for any order in memory and any length of the lists.
START_TEST(forces_do_not_depend_on_the_order_in_memory) {
  const auto by_id = [](const Bubbles<2>& b) {
    std::map<std::int64_t, std::array<double, 2>> forces;
    const Vectors<2> in_memory = block_forces<2>(b, CubicLaw{});
    for (std::int64_t i = 0; i < b.nodes.count; ++i)
      forces[b.nodes.id(i)] = in_memory[static_cast<std::size_t>(i)];
    return forces;
  };
  Bubbles<2> b = random_set<2>(34, 2000);
  const auto expected = by_id(b);
  Random random(35);
  for (const double radius : {1.5, 1.7, 2.9}) {
    std::vector<Bubble<2>> bubbles = b.bubbles();
    random.shuffle(bubbles);
    b.set(bubbles);
    b.list(radius);
    quick_assert(by_id(b) == expected);
  }
}
END_TEST

START_TEST(accelerations_are_scaled_and_damped) {
  Bubbles<3> b = random_set<3>(36, 300);
  std::vector<Bubble<3>> bubbles = b.bubbles();
  for (std::size_t i = 0; i < bubbles.size(); i += 5) bubbles[i].moves = false;
  b.set(bubbles);
  b.list(1.7);
  bubbles = b.bubbles();
  Random random(37);
  pnpbs::Field<3> v, a;
  pnpbs::reserve_field<3>(v, "v", b.nodes.count);
  pnpbs::reserve_field<3>(a, "a", b.nodes.count);
  for (std::int64_t i = 0; i < b.nodes.count; ++i)
    for (std::size_t k = 0; k < 3; ++k) v[k](i) = random.between(-1, 1);
  pnpbs::Motion motion;
  motion.damping = 0.37;
  pnpbs::accelerations<3>(b.nodes, b.lists, CubicLaw{}, motion, b.nodes.x, v, a);
  for (std::size_t i = 0; i < bubbles.size(); ++i) {
    const DirectForce<3> direct = direct_force<3>(bubbles, i, CubicLaw{}, cubic);
    for (std::size_t k = 0; k < 3; ++k) {
      const double expected = bubbles[i].moves ? bubbles[i].d * direct.sum[k] - 0.37 * v[k](i) : 0;
      ck_assert_double_eq_tol(a[k](i), expected, 1e-13 * (1 + direct.magnitudes));
    }
  }
}
END_TEST

// Two regions are compressed alike, one with bubbles twice as large. With the stress-free law both
// exert the same force per length of their interface. (With the paper's law the fine region exerts
// twice as much.)
START_TEST(bubbles_squeezed_alike_press_alike) {
  constexpr double kSqueezed = 0.9;
  const LinearPush law;
  const CubicLaw letter;
  // Force of one pair per column of a square arrangement, over the width of the column.
  const auto stress = [&](const auto& of, double d) {
    const double distance = kSqueezed * d;
    return of.template per_length<2>(distance, d) * distance / distance;
  };
  ck_assert_double_eq_tol(stress(law, 0.1), stress(law, 0.2), 1e-14);
  ck_assert_double_eq_tol(stress(letter, 0.1), 2 * stress(letter, 0.2), 1e-13);
  const auto stress_in_volume = [&](double d) {
    return law.per_length<3>(kSqueezed * d, d) * kSqueezed * d / (kSqueezed * d * kSqueezed * d);
  };
  ck_assert_double_eq_tol(stress_in_volume(0.1), stress_in_volume(0.2), 1e-14);
  // Bubbles of all sizes are equally stiff: the acceleration over d is the same.
  const auto stiffness = [&](auto dim, double d) {
    constexpr int kDim = dim();
    return LinearPush::acceleration_scale<kDim>(d) * law.per_length<kDim>(kSqueezed * d, d);
  };
  const std::integral_constant<int, 2> plane;
  const std::integral_constant<int, 3> volume;
  ck_assert_double_eq_tol(stiffness(plane, 0.1), stiffness(plane, 0.2), 1e-14);
  ck_assert_double_eq_tol(stiffness(volume, 0.1), stiffness(volume, 0.2), 1e-14);
}
END_TEST

START_TEST(hexagonal_lattice_is_free_of_forces) {
  const double d = 0.05;
  Bubbles<2> b;
  b.grow_tree([=](const Point<2>&) { return d; });
  b.set(hexagonal_lattice(b.box, d, d, 1.6 * d));
  b.list(1.7);
  const Vectors<2> pull = block_forces<2>(b, CubicLaw{}),
                   push_only = block_forces<2>(b, LinearPush{});
  std::int64_t inner = 0;
  for (std::int64_t i = 0; i < b.nodes.count; ++i) {
    if (!b.nodes.moves(i)) continue;
    ++inner;
    for (std::size_t k = 0; k < 2; ++k) {
      ck_assert_double_eq_tol(pull[static_cast<std::size_t>(i)][k], 0, 1e-13);
      ck_assert_double_eq_tol(push_only[static_cast<std::size_t>(i)][k], 0, 1e-13);
    }
    ck_assert_double_eq_tol(pnpbs::overlap_ratio<2>(b.nodes, b.lists, i), 6, 1e-12);
  }
  ck_assert_int_gt(inner, 200);
}
END_TEST

// Two coincident nodes exert no force on each other, and no force becomes NaN.
START_TEST(coincident_nodes) {
  Bubbles<2> b;
  b.grow_tree([](const Point<2>&) { return 0.2; });
  b.set({{{0.5, 0.5}, 0.2, 4}, {{0.5, 0.5}, 0.2, 9}, {{0.6, 0.5}, 0.2, 1}});
  b.list(1.7);
  const Vectors<2> forces = block_forces<2>(b, CubicLaw{});
  for (std::int64_t i = 0; i < 3; ++i) {
    const double expected = (b.nodes.id(i) == 1 ? 2 : -1) * cubic(0.5);
    ck_assert_double_eq_tol(forces[static_cast<std::size_t>(i)][0], expected, 1e-14);
    ck_assert_double_eq_tol(forces[static_cast<std::size_t>(i)][1], 0, 1e-14);
  }
}
END_TEST

START_TEST(overlap_ratio_of_lattices) {
  Bubbles<2> plane;
  std::vector<Point<2>> line;
  for (int i = 0; i <= 10; ++i) line.push_back({0.1 * i, 0.5});
  ck_assert_double_eq_tol(ratio_in_the_middle<2>(plane, line, 0.1), 2, 1e-12);

  // A face-centred cubic lattice with nearest distance d: 12 neighbours are at d, and the 6 of the
  // second shell at sqrt(2) d are still within 1.5 d.
  Bubbles<3> volume;
  const double d = 0.14;
  const auto close_packing =
      crystal(d * std::sqrt(2.0), {{0, 0, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}, {0.5, 0.5, 0}});
  ck_assert_double_eq_tol(ratio_in_the_middle<3>(volume, close_packing, d),
                          12 + 6 * (3 - 2 * std::sqrt(2.0)), 1e-11);

  // A body-centred cubic lattice whose mean Delaunay edge is d. A node has 8 edges of half the cell
  // diagonal and 6 of the cell side.
  const double cell = 14 * d / (4 * std::sqrt(3.0) + 6);
  ck_assert_double_eq_tol(2 / std::pow(cell / d, 3), 1.575, 1e-3);
  const auto body_centred = crystal(cell, {{0, 0, 0}, {0.5, 0.5, 0.5}});
  ck_assert_double_eq_tol(ratio_in_the_middle<3>(volume, body_centred, d), 14, 1e-11);
}
END_TEST

START_TEST(overlap_ratio_is_the_direct_sum) {
  expect_direct_ratio<2>();
  expect_direct_ratio<3>();
}
END_TEST

TEST_SUITE(test_forces) {
  return run_kernel_suite(
      "forces",
      {cubic_law, linear_push, forces_are_the_direct_sum, forces_are_the_gradient_of_an_energy,
       forces_do_not_depend_on_the_order_in_memory, accelerations_are_scaled_and_damped,
       bubbles_squeezed_alike_press_alike, hexagonal_lattice_is_free_of_forces, coincident_nodes,
       overlap_ratio_of_lattices, overlap_ratio_is_the_direct_sum});
}
