// SPDX-License-Identifier: BSD-3-Clause
#include "population/population.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "neighbors/rings.hpp"
#include "population/overlap_ratio.hpp"

namespace pnpbs {

namespace {

// What a node brings to the contest; defect 0 is no candidate.
struct Bid {
  double defect = 0;
  std::int64_t id = -1;

  bool beats(const Bid& other) const {
    return defect > other.defect || (defect == other.defect && id > other.id);
  }
};

enum class Action : char { none, remove, insert };

template <int Dim>
double dot(const Point<Dim>& a, const Point<Dim>& b) {
  double sum = 0;
  for (int k = 0; k < Dim; ++k) sum += a[k] * b[k];
  return sum;
}

// Square to `a`: the axis that is least along it, without the part along it.
template <int Dim>
Point<Dim> square_to(const Point<Dim>& a) {
  int min = 0;
  for (int k = 1; k < Dim; ++k)
    if (std::fabs(a[k]) < std::fabs(a[min])) min = k;
  Point<Dim> b{};
  b[min] = 1;
  const double length = dot<Dim>(a, a);
  if (length == 0) return b;
  for (int k = 0; k < Dim; ++k) b[k] -= a[min] * a[k] / length;
  return b;
}

// One spacing away on the side away from its neighbours; where they balance, as in a row of nodes,
// that is beside the row.
template <int Dim>
Point<Dim> place_away(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists, std::int64_t i) {
  constexpr double kBalanced = 0.1;  // of what they would be on one side
  const Point<Dim> x = nodes.position(i);
  Point<Dim> crowd{}, to_nearest{};
  double weights = 0, nearest = std::numeric_limits<double>::infinity();
  lists.for_neighbours(i, [&](std::int64_t j) {
    const Point<Dim> y = nodes.position(j);
    const double gap = distance<Dim>(x, y);
    if (gap == 0) return;
    const double weight = 1 / (gap * gap);
    for (int k = 0; k < Dim; ++k) crowd[k] += weight * (y[k] - x[k]);
    weights += weight * gap;
    if (gap >= nearest) return;
    nearest = gap;
    for (int k = 0; k < Dim; ++k) to_nearest[k] = y[k] - x[k];
  });
  Point<Dim> away;
  for (int k = 0; k < Dim; ++k) away[k] = -crowd[k];
  if (dot<Dim>(away, away) <= kBalanced * kBalanced * weights * weights) {
    away = square_to<Dim>(to_nearest);
    if (dot<Dim>(away, crowd) > 0)
      for (int k = 0; k < Dim; ++k) away[k] = -away[k];
  }
  const double length = std::sqrt(dot<Dim>(away, away));
  Point<Dim> place;
  for (int k = 0; k < Dim; ++k) place[k] = x[k] + nodes.d(i) * (away[k] / length);
  return place;
}

// The centre of the circle through x and two others; none if they lie on a line.
std::optional<Point<2>> circumcentre(const Point<2>& x, const std::array<Point<2>, 2>& others) {
  const auto& [b, c] = others;
  const double bx = b[0] - x[0], by = b[1] - x[1], cx = c[0] - x[0], cy = c[1] - x[1];
  const double area = 2 * (bx * cy - by * cx);
  if (area == 0) return std::nullopt;
  const double bb = bx * bx + by * by, cc = cx * cx + cy * cy;
  return Point<2>{x[0] + (cy * bb - by * cc) / area, x[1] + (bx * cc - cx * bb) / area};
}

Point<3> cross(const Point<3>& a, const Point<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// The centre of the sphere through x and three others; none if they lie in a plane.
std::optional<Point<3>> circumcentre(const Point<3>& x, const std::array<Point<3>, 3>& others) {
  std::array<Point<3>, 3> to;
  std::array<double, 3> square;
  for (std::size_t n = 0; n < 3; ++n) {
    for (std::size_t k = 0; k < 3; ++k) to[n][k] = others[n][k] - x[k];
    square[n] = dot<3>(to[n], to[n]);
  }
  const std::array<Point<3>, 3> normal{cross(to[1], to[2]), cross(to[2], to[0]),
                                       cross(to[0], to[1])};
  const double volume = 2 * dot<3>(to[0], normal[0]);
  if (volume == 0) return std::nullopt;
  Point<3> centre;
  for (std::size_t k = 0; k < 3; ++k)
    centre[k] =
        x[k] +
        (square[0] * normal[0][k] + square[1] * normal[1][k] + square[2] * normal[2][k]) / volume;
  return centre;
}

// Calls visit(corners) for all choices of Dim of the first `end` points; `Left` are to be chosen.
template <int Left, int Dim, class Visit>
void for_choices(const std::vector<Point<Dim>>& points, std::size_t end,
                 std::array<Point<Dim>, Dim>& corners, const Visit& visit) {
  if constexpr (Left == 0) {
    visit(corners);
  } else {
    for (std::size_t j = 0; j < end; ++j) {
      corners[Dim - Left] = points[j];
      for_choices<Left - 1, Dim>(points, j, corners, visit);
    }
  }
}

// The middle of the largest hole beside node i: of the circles (spheres) through it and two (three)
// neighbours that hold none, the one with the largest radius up to d. None if there is a larger
// one, or the node has too few neighbours.
template <int Dim>
std::optional<Point<Dim>> hole_beside(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists,
                                      std::int64_t i) {
  constexpr double kRounding = 1 - 1e-9;
  std::vector<Point<Dim>> around;
  lists.for_neighbours(i, [&](std::int64_t j) { around.push_back(nodes.position(j)); });
  const Point<Dim> x = nodes.position(i);
  const auto is_empty = [&](const Point<Dim>& centre, double radius) {
    return std::none_of(around.begin(), around.end(), [&](const Point<Dim>& y) {
      return distance<Dim>(y, centre) < kRounding * radius;
    });
  };
  std::optional<Point<Dim>> hole;
  double max = 0;
  std::array<Point<Dim>, Dim> corners;
  for_choices<Dim, Dim>(around, around.size(), corners, [&](const auto& chosen) {
    const std::optional<Point<Dim>> centre = circumcentre(x, chosen);
    if (!centre) return;
    const double radius = distance<Dim>(x, *centre);
    if (radius <= max || !is_empty(*centre, radius)) return;
    max = radius;
    hole = centre;
  });
  if (max > nodes.d(i)) hole.reset();
  return hole;
}

// The free place beside a sparse bubble.
template <int Dim>
Point<Dim> free_place(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists, std::int64_t i) {
  if (const std::optional<Point<Dim>> hole = hole_beside<Dim>(nodes, lists, i)) return *hole;
  return place_away<Dim>(nodes, lists, i);
}

// Is there room at `place` among the neighbours of i and theirs? Boundary nodes give no way, so
// they always need the full gap.
template <int Dim>
bool has_room(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists, std::int64_t i,
              const Point<Dim>& place, double gap, const PopulationRule<Dim>& rule) {
  const auto leaves_room = [&](std::int64_t j, int) {
    const double desired = 0.5 * (nodes.d(i) + nodes.d(j));
    const double needed = nodes.moves(j) ? gap : rule.min_gap;
    return distance<Dim>(nodes.position(j), place) >= needed * desired;
  };
  return leaves_room(i, 0) && for_rings(lists, i, 2, leaves_room);
}

// The overlap ratio that a bubble like i would have at `place`, as far as i, its neighbours and
// theirs tell.
template <int Dim>
double overlap_ratio_at(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists, std::int64_t i,
                        const Point<Dim>& place) {
  std::vector<std::pair<std::int64_t, double>> overlaps;  // by id, so that the sum has an order
  const auto add = [&](std::int64_t j, int) {
    const double gap = distance<Dim>(nodes.position(j), place);
    overlaps.emplace_back(nodes.id(j), overlap(nodes.d(i), nodes.d(j), gap));
    return true;
  };
  add(i, 0);
  for_rings(lists, i, 2, add);
  std::sort(overlaps.begin(), overlaps.end());
  double sum = 0;
  for (const auto& [id, term] : overlaps) sum += std::max(0.0, term);
  return sum / (0.5 * nodes.d(i));
}

// The contest: does no node within three hops bid more than node i? Nodes across a hole from each
// other are two spacings apart, which two hops around it may not bridge.
template <int Dim>
bool wins(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists, const View<double>& defects,
          std::int64_t i) {
  constexpr int kHops = 3;
  const Bid own{defects(i), nodes.id(i)};
  return for_rings(lists, i, kHops, [&](std::int64_t j, int) {
    return !Bid{defects(j), nodes.id(j)}.beats(own);
  });
}

}  // namespace

template <int Dim>
PopulationChange<Dim> choose_population_change(
    const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists, const View<double>& ratios,
    const PopulationRule<Dim>& rule, const PopulationThresholds& thresholds,
    const std::function<bool(std::int64_t)>& must_go,
    const std::function<bool(const Point<Dim>&, double)>& fits) {
  const View<double> defects = make_view<double>("pnpbs::population::defects", nodes.count);
  const View<Action> action = make_view<Action>("pnpbs::population::action", nodes.count);
  for_each_guarded("pnpbs::population::bid", nodes.count, [&](std::int64_t i) {
    defects(i) = 0;
    action(i) = Action::none;
    if (!nodes.moves(i)) return;
    const double ratio = ratios(i);
    const PopulationThresholds::Pair& threshold = thresholds.at(nodes.d(i));
    if (must_go(i)) {
      defects(i) = std::numeric_limits<double>::max();
      action(i) = Action::remove;
    } else if (ratio > threshold.delete_above) {
      defects(i) = ratio - rule.ideal;
      action(i) = Action::remove;
    } else if (ratio < std::max(rule.insert_below, threshold.insert_below)) {
      const double gap = ratio < threshold.insert_below ? rule.min_gap_to_aim : rule.min_gap;
      const Point<Dim> place = free_place<Dim>(nodes, lists, i);
      // Between boundary nodes that are dense for d a new bubble may be one too many: it would
      // go at once, and come again.
      if (has_room<Dim>(nodes, lists, i, place, gap, rule) && fits(place, nodes.d(i)) &&
          overlap_ratio_at<Dim>(nodes, lists, i, place) <= rule.delete_above) {
        defects(i) = rule.ideal - ratio;
        action(i) = Action::insert;
      }
    }
  });
  std::vector<std::int32_t> bidders;  // mostly few
  for (std::int32_t i = 0; i < nodes.count; ++i)
    if (action(i) != Action::none) bidders.push_back(i);
  std::vector<char> winner(bidders.size());
  for_each_guarded("pnpbs::population::contest", static_cast<std::int64_t>(bidders.size()),
                   [&](std::int64_t b) {
                     const auto k = static_cast<std::size_t>(b);
                     winner[k] = wins<Dim>(nodes, lists, defects, bidders[k]);
                   });
  PopulationChange<Dim> change;
  for (std::size_t b = 0; b < bidders.size(); ++b) {
    if (winner[b] == 0) continue;
    const std::int32_t i = bidders[b];
    if (action(i) == Action::remove) {
      change.deleted.push_back(i);
    } else {
      change.born.push_back({free_place<Dim>(nodes, lists, i), nodes.id(i), nodes.d(i)});
      change.parents.push_back(i);
    }
  }
  return change;
}

template PopulationChange<2> choose_population_change<2>(
    const Nodes<2>&, const AdjacencyList<2>&, const View<double>&, const PopulationRule<2>&,
    const PopulationThresholds&, const std::function<bool(std::int64_t)>&,
    const std::function<bool(const Point<2>&, double)>&);
template PopulationChange<3> choose_population_change<3>(
    const Nodes<3>&, const AdjacencyList<3>&, const View<double>&, const PopulationRule<3>&,
    const PopulationThresholds&, const std::function<bool(std::int64_t)>&,
    const std::function<bool(const Point<3>&, double)>&);

}  // namespace pnpbs
