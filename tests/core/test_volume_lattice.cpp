// SPDX-License-Identifier: BSD-3-Clause
// The lattice that bubbles in space settle into, and the default law: against formulas, direct sums
// over all pairs and differences of the energy.
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "dynamics/bubble_force.hpp"
#include "population/population_thresholds.hpp"
#include "run_kernel_suite.hpp"
#include "volume_box.hpp"

using pnpbs::SmoothPush;
using volume_box::kCell;
using Bcc = pnpbs::Lattice<3>;

namespace {

constexpr double kRange = 1.2;

// f(w), and its integral from w to the range.
double formula(double w) { return w < kRange ? std::pow(1 - std::pow(w / kRange, 2), 2) : 0; }
double energy(double w) {
  const double u = w / kRange;
  return u < 1 ? kRange * (8.0 / 15 - u + 2 * std::pow(u, 3) / 3 - std::pow(u, 5) / 5) : 0;
}

template <int Dim>
double graded(const Point<Dim>& x) {
  return (Dim == 2 ? 0.04 : 0.08) + 0.1 * x[0];
}

template <int Dim>
Bubbles<Dim> random_set(std::uint64_t seed) {
  Random random(seed);
  Bubbles<Dim> b;
  b.grow_tree(graded<Dim>);
  b.set(random_bubbles<Dim>(random, 900, graded<Dim>));
  b.list(1.5);
  return b;
}

template <int Dim>
std::vector<Point<Dim>> forces_on(const Bubbles<Dim>& b) {
  std::vector<Point<Dim>> forces(static_cast<std::size_t>(b.nodes.count));
  for (std::int64_t block = 0; block < b.lists.block_count(); ++block) {
    std::int64_t self[pnpbs::kLanes];
    pnpbs::block_nodes(block, b.nodes.count, self);
    pnpbs::BlockVector<Dim> force;
    pnpbs::block_force<Dim>(b.lists.block(block), SmoothPush{}, pnpbs::positions_of<Dim>(b.nodes.x),
                            b.nodes.d.data(), self, force);
    for (std::size_t lane = 0; lane < pnpbs::kLanes; ++lane)
      for (std::size_t k = 0; k < Dim && self[lane] < b.nodes.count; ++k)
        forces[static_cast<std::size_t>(self[lane])][k] = force[k][lane];
  }
  return forces;
}

// Energy of a pair. Minus its derivative by the distance is d_ij^(Dim-1) f(w).
template <int Dim>
double energy_at(const std::vector<Bubble<Dim>>& all, std::size_t i, const Point<Dim>& x) {
  double sum = 0;
  for (std::size_t j = 0; j < all.size(); ++j) {
    const double desired = 0.5 * (all[i].d + all[j].d);
    if (j != i) sum += std::pow(desired, Dim) * energy(pnpbs::distance<Dim>(x, all[j].x) / desired);
  }
  return sum;
}

template <int Dim>
void expect_direct_sum() {
  const Bubbles<Dim> b = random_set<Dim>(91);
  const std::vector<Point<Dim>> forces = forces_on<Dim>(b);
  const std::vector<Bubble<Dim>> all = b.bubbles();
  double strongest = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    Point<Dim> sum{};
    double magnitudes = 0;
    for (std::size_t j = 0; j < all.size(); ++j) {
      if (j == i) continue;
      const double gap = pnpbs::distance<Dim>(all[i].x, all[j].x);
      const double desired = 0.5 * (all[i].d + all[j].d);
      const double f = std::pow(desired, Dim - 1) * formula(gap / desired);
      for (std::size_t k = 0; k < Dim; ++k) sum[k] += f * (all[i].x[k] - all[j].x[k]) / gap;
      magnitudes += f;
    }
    for (std::size_t k = 0; k < Dim; ++k)
      ck_assert_double_eq_tol(forces[i][k], sum[k], 1e-14 * (1 + magnitudes));
    strongest = std::max(strongest, magnitudes / std::pow(all[i].d, Dim - 1));
  }
  ck_assert_double_gt(strongest, 2);  // there were forces to add
}

template <int Dim>
void expect_gradient() {
  const Bubbles<Dim> b = random_set<Dim>(92);
  const std::vector<Point<Dim>> forces = forces_on<Dim>(b);
  const std::vector<Bubble<Dim>> all = b.bubbles();
  constexpr double kStep = 1e-6;
  for (std::size_t i = 0; i < all.size(); i += 7)
    for (std::size_t k = 0; k < Dim; ++k) {
      Point<Dim> ahead = all[i].x, behind = all[i].x;
      ahead[k] += kStep;
      behind[k] -= kStep;
      const double slope =
          (energy_at<Dim>(all, i, ahead) - energy_at<Dim>(all, i, behind)) / (2 * kStep);
      ck_assert_double_eq_tol(forces[i][k], -slope, 1e-7);
    }
}

Bubbles<3> perfect(double radius) {
  const volume_box::Crystal crystal{7};
  Bubbles<3> b;
  b.box = crystal.box();
  b.grow_tree([](const Point<3>&) { return 1.0; });
  b.set(volume_box::sites(crystal));
  b.list(radius);
  return b;
}

}  // namespace

START_TEST(numbers_of_the_lattice) {
  const double half_diagonal = std::sqrt(0.75) * kCell;
  ck_assert_double_eq_tol((8 * half_diagonal + 6 * kCell) / Bcc::kNeighbours, 1, 1e-15);
  ck_assert_double_eq_tol(Bcc::kDensity, 2 / std::pow(kCell, 3), 1e-14);
  ck_assert_double_eq_tol(pnpbs::Lattice<2>::kDensity, 2 / std::sqrt(3.0), 1e-15);
  ck_assert_double_eq(pnpbs::power<3>(1.5), 3.375);
}
END_TEST

// A node has eight neighbours at half the diagonal and six at the side of a cell; a longer radius
// adds the twelve along the face diagonals. The overlap ratio is the ideal one, and forces vanish.
START_TEST(neighbours_in_the_lattice) {
  for (const double radius : {1.0, 1.5, 1.6}) {
    const Bubbles<3> b = perfect(radius);
    const std::vector<Point<3>> forces = forces_on<3>(b);
    std::int64_t inner = 0;
    for (std::int64_t i = 0; i < b.nodes.count; ++i) {
      if (!b.nodes.moves(i)) continue;
      ++inner;
      std::map<int, int> shells;
      const Point<3> x = b.nodes.position(i);
      b.lists.for_neighbours(i, [&](std::int64_t j) {
        const double gap = pnpbs::distance<3>(x, b.nodes.position(j)) / kCell;
        const int shell = static_cast<int>(std::lround(4 * gap * gap));
        ck_assert_double_eq_tol(4 * gap * gap, shell, 1e-12);
        ++shells[shell];
      });
      std::map<int, int> expected{{3, 8}};
      if (radius > 1.1) expected[4] = 6;
      if (radius > 1.54) expected[8] = 12;
      quick_assert(shells == expected);
      for (std::size_t k = 0; k < 3; ++k)
        ck_assert_double_eq_tol(forces[static_cast<std::size_t>(i)][k], 0, 1e-13);
      if (radius > 1.1)
        ck_assert_double_eq_tol(pnpbs::overlap_ratio<3>(b.nodes, b.lists, i), Bcc::kIdealOverlap,
                                1e-12);
    }
    ck_assert_int_gt(inner, 100);
  }
}
END_TEST

START_TEST(smooth_push) {
  const SmoothPush law{3};
  for (int step = 0; step <= 1300; ++step)
    ck_assert_double_eq_tol(law(step * 1e-3), 3 * formula(step * 1e-3), 1e-15);
  for (const double w : {1.2, std::nextafter(1.2, 2.0), 3.0, 1e100}) {
    quick_assert(std::fabs(law(w)) < 1e-30);
    quick_assert(law.per_length<3>(w, 1) < 1e-30 && law.per_length<3>(1e100, 1e-9) == 0);
  }
}
END_TEST

// The stress is equal for fine and coarse bubbles, and so is the stiffness.
START_TEST(smooth_push_is_free_of_stress) {
  const SmoothPush law;
  const auto force = [&](double d) { return law.per_length<3>(0.9 * d, d) * 0.9 * d; };
  ck_assert_double_eq_tol(force(0.1) / 0.01, force(0.3) / 0.09, 1e-14);
  const auto acceleration = [&](double d) {
    return SmoothPush::acceleration_scale<3>(d) * force(d);
  };
  ck_assert_double_eq_tol(acceleration(0.1) / 0.1, acceleration(0.3) / 0.3, 1e-14);
}
END_TEST

START_TEST(forces_are_the_direct_sum) {
  expect_direct_sum<2>();
  expect_direct_sum<3>();
}
END_TEST

START_TEST(forces_are_the_gradient_of_an_energy) {
  expect_gradient<2>();
  expect_gradient<3>();
}
END_TEST

TEST_SUITE(test_volume_lattice) {
  return run_kernel_suite("volume_lattice",
                          {numbers_of_the_lattice, neighbours_in_the_lattice, smooth_push,
                           smooth_push_is_free_of_stress, forces_are_the_direct_sum,
                           forces_are_the_gradient_of_an_energy});
}
