// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/periodic_copies.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/point_text.hpp"
#include "method/constants.hpp"

namespace pnpbs {

namespace {

constexpr double kReach = 26;       // distance up to which a node depends on others at once [d]
constexpr double kLeastPeriod = 4;  // [d]

// Returns the largest of some samples of d in the cell.
template <int Dim>
double largest_spacing(const PeriodicCell<Dim>& cell, double measure, const Spacing<Dim>& spacing) {
  constexpr int kAlong = Dim == 2 ? 33 : 13;
  std::vector<Point<Dim>> x;
  const int count = Dim == 2 ? kAlong * kAlong : kAlong * kAlong * kAlong;
  for (int n = 0; n < count; ++n) {
    Point<Dim> at;
    for (int k = 0, rest = n; k < Dim; ++k, rest /= kAlong)
      at[k] = cell.box().low[k] +
              (cell.box().high[k] - cell.box().low[k]) * ((rest % kAlong) + 0.5) / kAlong;
    x.push_back(at);
  }
  std::vector<double> d(x.size());
  evaluate_spacing<Dim>(spacing, measure, count, x.data(), d.data());
  return *std::ranges::max_element(d);
}

// Returns the periodic axis with the shortest period.
template <int Dim>
int shortest_axis(const PeriodicCell<Dim>& cell) {
  int shortest = -1;
  for (int k = 0; k < Dim; ++k)
    if (cell.periodic(k) && (shortest < 0 || cell.period(k) < cell.period(shortest))) shortest = k;
  return shortest;
}

// Returns points on the periodic side of the cell at the low end of an axis.
template <int Dim>
std::vector<Point<Dim>> points_on_side(const PeriodicCell<Dim>& cell, int axis) {
  constexpr int kAlong = Dim == 2 ? 33 : 13;
  constexpr int kCount = Dim == 2 ? kAlong : kAlong * kAlong;
  std::vector<Point<Dim>> points;
  for (int n = 0; n < kCount; ++n) {
    Point<Dim> x = cell.box().low;
    for (int k = 0, rest = n; k < Dim; ++k) {
      if (k == axis) continue;
      x[k] += (cell.box().high[k] - cell.box().low[k]) * ((rest % kAlong) + 0.5) / kAlong;
      rest /= kAlong;
    }
    points.push_back(x);
  }
  return points;
}

// Throws if the user's function differs between points of the cell that are the same point of the
// domain, by more than nodes can follow. Values on a grid, a mesh or at points are continued with
// the periods.
template <int Dim>
void require_periodic(const PeriodicCell<Dim>& cell, const Spacing<Dim>& spacing) {
  if (spacing.extent()) return;
  for (int axis = 0; axis < Dim; ++axis) {
    if (!cell.periodic(axis)) continue;
    std::vector<Point<Dim>> x = points_on_side(cell, axis);
    const std::size_t count = x.size();
    for (std::size_t i = 0; i < count; ++i) {
      x.push_back(x[i]);
      x.back()[axis] = cell.box().high[axis];
    }
    std::vector<double> d(x.size());
    spacing.evaluate(std::ssize(x), x.data(), d.data());
    for (std::size_t i = 0; i < count; ++i) {
      const double low = d[i], high = d[count + i];
      if (!(std::fabs(low - high) > method::kGrowthFollowed * std::min(low, high))) continue;
      throw Error(ErrorKind::spacing, "the spacing is not periodic: d = " + number_text(low) +
                                          " at " + point_text(x[i]) + ", and d = " +
                                          number_text(high) + " at " + point_text(x[count + i]) +
                                          ", which is the same point of the periodic domain: " +
                                          "use a function with the periods of the domain");
    }
  }
}

}  // namespace

template <int Dim>
std::shared_ptr<const Domain<Dim>> with_copies(const std::shared_ptr<const Domain<Dim>>& domain,
                                               const SizingField<Dim>& spacing) {
  const PeriodicCell<Dim>& cell = domain->cell();
  if (!cell.any()) return domain;
  require_periodic(cell, spacing.source());
  const double d = largest_spacing(cell, measure_of(*domain), spacing);
  const int axis = shortest_axis(cell);
  if (!(cell.period(axis) >= kLeastPeriod * d))
    throw Error(ErrorKind::spacing, "the domain has the period " + number_text(cell.period(axis)) +
                                        " along axis " + std::to_string(axis) +
                                        ", less than 4 spacings of " + number_text(d) +
                                        ": make d smaller, or the domain several periods long");
  auto copied = std::make_shared<Domain<Dim>>(*domain);
  copied->set_reach(kReach * d);
  copied->check();
  return copied;
}

template <int Dim>
bool periods_suffice(const Domain<Dim>& domain, const Spacing<Dim>& spacing) {
  const PeriodicCell<Dim>& cell = domain.cell();
  return !cell.any() || cell.period(shortest_axis(cell)) >=
                            kReach * largest_spacing(cell, measure_of(domain), spacing);
}

template std::shared_ptr<const PlaneDomain> with_copies(const std::shared_ptr<const PlaneDomain>&,
                                                        const SizingField<2>&);
template std::shared_ptr<const VolumeDomain> with_copies(const std::shared_ptr<const VolumeDomain>&,
                                                         const SizingField<3>&);
template bool periods_suffice(const PlaneDomain&, const Spacing<2>&);
template bool periods_suffice(const VolumeDomain&, const Spacing<3>&);

}  // namespace pnpbs
