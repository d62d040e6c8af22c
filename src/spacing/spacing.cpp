// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/spacing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/execution.hpp"
#include "base/lattice.hpp"
#include "base/point_text.hpp"

namespace pnpbs {

template <int Dim>
void Spacing<Dim>::distance_to_extent(std::int64_t n, const Point<Dim>* x,
                                      double* distances) const {
  const std::optional<GivenExtent<Dim>> given = extent();
  for (std::int64_t i = 0; i < n; ++i) {
    double square = 0;
    for (int k = 0; given && k < Dim; ++k) {
      const double gap = std::max({0.0, given->box.low[k] - x[i][k], x[i][k] - given->box.high[k]});
      square += gap * gap;
    }
    distances[i] = std::sqrt(square);
  }
}

template <int Dim>
void ConstantSpacing<Dim>::evaluate(std::int64_t n, const Point<Dim>*, double* d) const {
  std::fill(d, d + n, d_);
}

template <int Dim>
void CallbackSpacing<Dim>::evaluate(std::int64_t n, const Point<Dim>* x, double* d) const {
  const std::int32_t answer = function_(n, n > 0 ? x->data() : nullptr, d);
  if (answer != 0)
    throw Error(ErrorKind::callback, "the spacing callback returned " + std::to_string(answer) +
                                         " for a batch of " + std::to_string(n) +
                                         " points; it must return 0");
}

template <int Dim>
double GridSpacing<Dim>::at(const Point<Dim>& x) const {
  std::array<std::int64_t, Dim> cell;
  Point<Dim> weight;
  for (int k = 0; k < Dim; ++k) {
    const double last = static_cast<double>(size_[k] - 1);
    const double t = std::clamp((x[k] - origin_[k]) / step_[k], 0.0, last);
    cell[k] = std::min(static_cast<std::int64_t>(t), std::max<std::int64_t>(size_[k] - 2, 0));
    weight[k] = t - static_cast<double>(cell[k]);
  }
  double sum = 0;
  for (int corner = 0; corner < (1 << Dim); ++corner) {
    double share = 1;
    std::int64_t index = 0;
    for (int k = Dim - 1; k >= 0; --k) {
      const int upper = (corner >> k) & 1;
      share *= upper ? weight[k] : 1 - weight[k];
      index = index * size_[k] + std::min(cell[k] + upper, size_[k] - 1);
    }
    if (share > 0) sum += share * values_[static_cast<std::size_t>(index)];
  }
  return sum;
}

template <int Dim>
void GridSpacing<Dim>::evaluate(std::int64_t n, const Point<Dim>* x, double* d) const {
  for_each("pnpbs::GridSpacing::evaluate", n, [=, this](std::int64_t i) { d[i] = at(x[i]); });
}

template <int Dim>
Point<Dim> GridSpacing<Dim>::grid_point(std::int64_t index) const {
  Point<Dim> x;
  for (int k = 0; k < Dim; ++k) {
    x[k] = origin_[k] + static_cast<double>(index % size_[k]) * step_[k];
    index /= size_[k];
  }
  return x;
}

// Steps between grid points count if d changes by a considerable share; noise on a fine grid is
// steep but small.
template <int Dim>
SpacingHints<Dim> GridSpacing<Dim>::spacing_hints() const {
  constexpr double kMatters = 0.1;
  SpacingHints<Dim> known;
  const auto count = static_cast<std::int64_t>(values_.size());
  std::vector<char> is_low(values_.size(), 0);
  std::int64_t next = 1;  // index distance of neighbours along axis k
  for (int k = 0; k < Dim; ++k) {
    for (std::int64_t i = 0; i + next < count; ++i) {
      if (i / next % size_[k] + 1 == size_[k]) continue;
      const std::int64_t j = i + next;
      const double a = values_[static_cast<std::size_t>(i)],
                   b = values_[static_cast<std::size_t>(j)];
      if (!(std::fabs(a - b) > kMatters * std::min(a, b))) continue;
      is_low[static_cast<std::size_t>(a < b ? i : j)] = 1;
      known.slopes.push_back({std::fabs(a - b) / step_[k], std::min(a, b),
                              middle_of<Dim>(grid_point(i), grid_point(j))});
    }
    next *= size_[k];
  }
  for (std::int64_t i = 0; i < count; ++i)
    if (is_low[static_cast<std::size_t>(i)])
      known.values.push_back({grid_point(i), values_[static_cast<std::size_t>(i)]});
  return known;
}

template <int Dim>
std::optional<GivenExtent<Dim>> GridSpacing<Dim>::extent() const {
  Box<Dim> box;
  for (int k = 0; k < Dim; ++k) {
    constexpr double endless = std::numeric_limits<double>::infinity();
    const double last = origin_[k] + static_cast<double>(size_[k] - 1) * step_[k];
    box.low[k] = size_[k] > 1 ? origin_[k] - 0.5 * step_[k] : -endless;
    box.high[k] = size_[k] > 1 ? last + 0.5 * step_[k] : endless;
  }
  return GivenExtent<Dim>{"grid", "d is that of the grid's nearest point", box};
}

namespace {

// Returns the number of nodes that a constant spacing d requires in a domain of this measure.
template <int Dim>
double meant_nodes(double d, double measure) {
  return Lattice<Dim>::kDensity * measure / power<Dim>(d);
}

}  // namespace

template <int Dim>
void evaluate_spacing(const Spacing<Dim>& spacing, double measure, std::int64_t n,
                      const Point<Dim>* x, double* d) {
  // more than any machine can store, even if only a small region requires them
  constexpr double kMaxNodes = 1e15;
  spacing.evaluate(n, x, d);
  for (std::int64_t i = 0; i < n; ++i) {
    if (std::isfinite(d[i]) && d[i] > 0 && meant_nodes<Dim>(d[i], measure) < kMaxNodes) continue;
    MessageText message = "spacing d = " + number_text(d[i]) + " at " + point_text(x[i]);
    if (!std::isfinite(d[i]))
      message += " is not finite; d must be a finite number greater than 0";
    else if (d[i] <= 0)
      message += " would mean infinitely many nodes; d must be greater than 0";
    else if (std::isfinite(meant_nodes<Dim>(d[i], measure)))
      message += " would mean about " + number_text(std::round(meant_nodes<Dim>(d[i], measure))) +
                 " nodes if it held in the whole domain; use a larger d";
    else
      message += " would mean more nodes than can be counted; use a larger d";
    throw Error(ErrorKind::spacing, message);
  }
}

template void evaluate_spacing<2>(const Spacing<2>&, double, std::int64_t, const Point<2>*,
                                  double*);
template void evaluate_spacing<3>(const Spacing<3>&, double, std::int64_t, const Point<3>*,
                                  double*);
template class Spacing<2>;
template class Spacing<3>;
template class ConstantSpacing<2>;
template class ConstantSpacing<3>;
template class CallbackSpacing<2>;
template class CallbackSpacing<3>;
template class GridSpacing<2>;
template class GridSpacing<3>;

}  // namespace pnpbs
