// SPDX-License-Identifier: BSD-3-Clause
// An independent implementation of population control as a search over all nodes, in the plane and
// in space.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "population_change.hpp"
#include "run_kernel_suite.hpp"

namespace {

template <int Dim>
struct Candidate {
  double defect = 0;
  bool removed = false;
  Point<Dim> place{};
};

// Solves rows * u = right by elimination with pivoting. Returns false if the rows are linearly
// dependent.
template <int Dim>
bool solve(std::array<Point<Dim>, Dim> rows, Point<Dim> right, Point<Dim>& u) {
  for (std::size_t c = 0; c < Dim; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c; r < Dim; ++r)
      if (std::fabs(rows[r][c]) > std::fabs(rows[pivot][c])) pivot = r;
    if (rows[pivot][c] == 0) return false;
    std::swap(rows[c], rows[pivot]);
    std::swap(right[c], right[pivot]);
    for (std::size_t r = 0; r < Dim; ++r) {
      if (r == c) continue;
      const double factor = rows[r][c] / rows[c][c];
      for (std::size_t k = 0; k < Dim; ++k) rows[r][k] -= factor * rows[c][k];
      right[r] -= factor * right[c];
    }
  }
  for (std::size_t c = 0; c < Dim; ++c) u[c] = right[c] / rows[c][c];
  return true;
}

// Finds the centre of the largest empty circle (sphere) through node i and Dim of its neighbours.
// Returns false if none exists, or if its radius exceeds d.
template <int Dim>
bool hole_by_search(const Set<Dim>& set, std::size_t i, double radius, Point<Dim>& middle) {
  const Point<Dim>& x = set[i].x;
  std::vector<Point<Dim>> around;
  for (std::size_t j = 0; j < set.size(); ++j)
    if (j != i && adjacent<Dim>(set[i], set[j], radius)) around.push_back(set[j].x);
  double max = 0;
  std::size_t choices = 1;
  for (int k = 0; k < Dim; ++k) choices *= around.size();
  for (std::size_t choice = 0; choice < choices; ++choice) {
    std::array<Point<Dim>, Dim> rows;
    Point<Dim> half_squares, u;
    std::size_t left = choice;
    for (std::size_t row = 0; row < Dim; ++row, left /= around.size()) {
      const Point<Dim>& other = around[left % around.size()];
      for (std::size_t k = 0; k < Dim; ++k) rows[row][k] = other[k] - x[k];
      half_squares[row] = 0.5 * pnpbs::squared_distance<Dim>(other, x);
    }
    if (!solve<Dim>(rows, half_squares, u)) continue;
    Point<Dim> y;
    for (std::size_t k = 0; k < Dim; ++k) y[k] = x[k] + u[k];
    const double r = pnpbs::distance<Dim>(x, y);
    const bool empty = std::all_of(around.begin(), around.end(), [&](const Point<Dim>& other) {
      return pnpbs::distance<Dim>(other, y) > r * (1 - 1e-8);
    });
    if (!empty || r <= max) continue;
    max = r;
    middle = y;
  }
  return max > 0 && max <= set[i].d;
}

template <int Dim>
Candidate<Dim> candidate(const Set<Dim>& set, std::size_t i, const PopulationRule& rule,
                         const Freedom& freedom, double radius) {
  Candidate<Dim> result;
  const Bubble<Dim>& own = set[i];
  result.place = own.x;
  if (!own.moves) return result;
  double ratio = 0;
  std::vector<Point<Dim>> around;
  for (std::size_t j = 0; j < set.size(); ++j) {
    if (j == i || !adjacent<Dim>(own, set[j], radius)) continue;
    const double gap = pnpbs::distance<Dim>(own.x, set[j].x);
    ratio += std::max(0.0, own.d + set[j].d / 2 - gap) / (own.d / 2);
    around.push_back(set[j].x);
  }
  if (freedom.must_go.count(own.id)) {
    result.defect = 1e300;
    result.removed = true;
  } else if (ratio > rule.delete_above) {
    result.defect = ratio - rule.ideal;
    result.removed = true;
  } else if (ratio < rule.insert_below) {
    if (!hole_by_search<Dim>(set, i, radius, result.place))
      result.place = pnpbs::free_place<Dim>(own.x, own.d, around);  // away from all neighbours
    if (!freedom.fits(result.place[0], result.place[1])) return result;
    double there = 0;  // overlap ratio of the new bubble
    for (std::size_t j : within_hops<Dim>(set, i, 2, radius)) {
      const double gap = pnpbs::distance<Dim>(set[j].x, result.place);
      if (j != i && gap < rule.min_gap * 0.5 * (own.d + set[j].d)) return result;
      there += std::max(0.0, own.d + set[j].d / 2 - gap) / (own.d / 2);
    }
    if (there > rule.delete_above) return result;
    result.defect = rule.ideal - ratio;
  }
  return result;
}

// Two candidates within this number of hops may compete.
constexpr int kHops = 3;
template <int Dim>
bool rivals(const Set<Dim>& set, const std::vector<Candidate<Dim>>& candidates, std::size_t i,
            std::size_t j) {
  return Dim == 2 ||
         pnpbs::distance<Dim>(candidates[i].place, candidates[j].place) <= 1.5 * set[i].d;
}

template <int Dim>
void expect_as_by_search(const Set<Dim>& set, const PopulationRule& rule, const Freedom& freedom,
                         double radius, std::size_t min_actors) {
  std::vector<Candidate<Dim>> candidates;
  for (std::size_t i = 0; i < set.size(); ++i)
    candidates.push_back(candidate<Dim>(set, i, rule, freedom, radius));
  Change<Dim> expected;
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (candidates[i].defect == 0) continue;
    bool wins = true;
    for (std::size_t j : within_hops<Dim>(set, i, kHops, radius))
      wins = wins &&
             (!rivals<Dim>(set, candidates, i, j) || candidates[j].defect < candidates[i].defect ||
              (candidates[j].defect == candidates[i].defect && set[j].id <= set[i].id));
    if (!wins) continue;
    if (candidates[i].removed)
      expected.deleted.insert(set[i].id);
    else
      expected.born[set[i].id] = candidates[i].place;
  }
  const Change<Dim> change = choose<Dim>(set, rule, freedom, radius);
  quick_assert(change.deleted == expected.deleted);
  ck_assert_uint_eq(change.born.size(), expected.born.size());
  for (const auto& [parent, place] : expected.born) {
    quick_assert(change.born.count(parent) == 1);
    ck_assert_double_lt(pnpbs::distance<Dim>(change.born.at(parent), place), 1e-11);
  }
  ck_assert_uint_ge(expected.deleted.size() + expected.born.size(), min_actors);

  // Another order in memory gives the same bits.
  Set<Dim> mixed = set;
  Random(61).shuffle(mixed);
  quick_assert(choose<Dim>(mixed, rule, freedom, radius) == change);
}

}  // namespace

START_TEST(contests_are_won_as_by_search) {
  Random random(63);
  const SpacingFunction<2> plane = [](const Point<2>& x) { return 0.05 + 0.06 * x[0]; };
  const SpacingFunction<3> volume = [](const Point<3>&) { return 0.16; };
  PopulationRule in_volume = by_thresholds<3>();
  in_volume.delete_above = 20;
  in_volume.insert_below = 11;
  in_volume.ideal = 14;
  for (const double radius : {1.5, 1.7}) {
    Set<2> set = random_bubbles<2>(random, 180, plane);
    for (std::size_t i = 0; i < set.size(); i += 11) set[i].moves = false;
    Freedom freedom;
    freedom.fits = [](double x, double y) { return x > 0 && x < 1 && y > 0 && y < 1; };
    expect_as_by_search<2>(set, {}, freedom, radius, 4);
    for (std::size_t i = 0; i < set.size(); i += 17) freedom.must_go.insert(set[i].id);
    expect_as_by_search<2>(set, {}, freedom, radius, 4);
    expect_as_by_search<3>(random_bubbles<3>(random, 200, volume), in_volume, freedom, radius, 2);
  }
}
END_TEST

TEST_SUITE(test_population_contest) {
  return run_kernel_suite("population_contest", {contests_are_won_as_by_search});
}
