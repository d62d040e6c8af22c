// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/periodic_copies.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/point_text.hpp"

namespace pnpbs {

namespace {

constexpr double kReach = 16;       // distance up to which a node depends on others at once [d]
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

}  // namespace

template <int Dim>
std::shared_ptr<const Domain<Dim>> with_copies(const std::shared_ptr<const Domain<Dim>>& domain,
                                               const Spacing<Dim>& spacing) {
  const PeriodicCell<Dim>& cell = domain->cell();
  if (!cell.any()) return domain;
  const double d = largest_spacing(cell, measure_of(*domain), spacing);
  const int axis = shortest_axis(cell);
  if (!(cell.period(axis) >= kLeastPeriod * d))
    throw Error(ErrorKind::spacing, "the domain has the period " + number_text(cell.period(axis)) +
                                        " along axis " + std::to_string(axis) +
                                        ", less than 4 spacings of " + number_text(d) +
                                        ": make d smaller, or the domain several periods long");
  Image<Dim> copies{};
  for (int k = 0; k < Dim; ++k)
    if (cell.periodic(k))
      copies[k] = std::min(static_cast<std::int32_t>(std::ceil(kReach * d / cell.period(k) + 0.5)),
                           PeriodicCell<Dim>::kFarthest);
  auto copied = std::make_shared<Domain<Dim>>(*domain);
  copied->set_copies(copies);
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
                                                        const Spacing<2>&);
template std::shared_ptr<const VolumeDomain> with_copies(const std::shared_ptr<const VolumeDomain>&,
                                                         const Spacing<3>&);
template bool periods_suffice(const PlaneDomain&, const Spacing<2>&);
template bool periods_suffice(const VolumeDomain&, const Spacing<3>&);

}  // namespace pnpbs
