// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/sizing_field.hpp"

#include <cmath>

#include "base/execution.hpp"

namespace pnpbs {

namespace {

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

template <int Dim>
void multiply(SpacingHints<Dim>& known, double factor) {
  if (factor == 1) return;
  for (GrowthSource<Dim>& value : known.values) value.d *= factor;
  for (GrowthSource<Dim>& value : known.in_domain) value.d *= factor;
  for (auto& slope : known.slopes) {
    slope.growth *= factor;
    slope.d *= factor;
  }
}

void multiply(std::int64_t n, double* d, double factor) {
  if (factor == 1) return;
  for (std::int64_t i = 0; i < n; ++i) d[i] *= factor;
}

}  // namespace

template <int Dim>
void SizingField<Dim>::add_undersampled_points(const SpacingHints<Dim>& places) {
  append(undersampled_points_.in_domain, places.in_domain);
  append(undersampled_points_.slopes, places.slopes);
}

template <int Dim>
SizingField<Dim> SizingField<Dim>::multiplied(double factor) const {
  SizingField result = *this;
  if (auto sizes = source_->with_sizes_multiplied(factor)) {
    result.source_ = std::move(sizes);
    multiply(result.undersampled_points_, factor);
  } else {
    result.factor_ *= factor;
  }
  return result;
}

template <int Dim>
void SizingField<Dim>::resolve(std::vector<GrowthSource<Dim>> sources, double growth) {
  resolving_ = std::make_shared<const Sources>(std::move(sources), growth);
}

template <int Dim>
void SizingField<Dim>::limit_growth(std::shared_ptr<const Communicator> comm,
                                    std::unique_ptr<const LineOfSight<Dim>> ways,
                                    const GrowthRule<Dim>& rule, const NodeLimit& limit) {
  growth_limit_ = std::make_shared<const GrowthLimit<Dim>>(std::move(comm), std::move(ways), *this,
                                                           rule, limit, [this] { beat(); });
}

template <int Dim>
void SizingField<Dim>::reduce_at(const std::vector<GrowthSource<Dim>>& places, double growth) {
  reductions_ = std::make_shared<const Sources>(places, growth);
  reduced_places_ = places;
}

template <int Dim>
SizingField<Dim> SizingField<Dim>::without_reductions() const {
  SizingField result = *this;
  result.reductions_.reset();
  result.reduced_places_.clear();
  return result;
}

template <int Dim>
SizingField<Dim> SizingField<Dim>::coarsened(double factor) const {
  SizingField result = *this;
  result.level_factor_ *= factor;
  return result;
}

template <int Dim>
void SizingField<Dim>::reduce(const Sources& sources, std::int64_t n, const Point<Dim>* x,
                              double* d) {
  for_each("pnpbs::SizingField::reduce", n,
           [&](std::int64_t i) { d[i] = sources.limit(x[i], d[i]); });
}

template <int Dim>
void SizingField<Dim>::evaluate(std::int64_t n, const Point<Dim>* x, double* d) const {
  if (!cell_.any()) return evaluate_in_cell(n, x, d);
  std::vector<Point<Dim>> in_cell(static_cast<std::size_t>(n));
  for_each("pnpbs::SizingField::evaluate", n,
           [&](std::int64_t i) { in_cell[static_cast<std::size_t>(i)] = cell_.in_cell(x[i]); });
  evaluate_in_cell(n, in_cell.data(), d);
}

template <int Dim>
void SizingField<Dim>::evaluate_in_cell(std::int64_t n, const Point<Dim>* x, double* d) const {
  beat();
  source_->evaluate(n, x, d);
  multiply(n, d, factor_);
  for (std::int64_t i = 0; i < n; ++i)
    if (d[i] > bound_ && std::isfinite(d[i])) d[i] = bound_;
  if (resolving_) reduce(*resolving_, n, x, d);
  if (growth_limit_) growth_limit_->limit(n, x, d);
  if (reductions_) reduce(*reductions_, n, x, d);
  multiply(n, d, level_factor_);
}

// The hints of the source are not needed if the growth is limited, because the limited d is sampled
// sufficiently.
template <int Dim>
SpacingHints<Dim> SizingField<Dim>::spacing_hints() const {
  SpacingHints<Dim> known;
  if (!growth_limit_) {
    known = source_->spacing_hints();
    append(known.in_domain, undersampled_points_.in_domain);
    append(known.slopes, undersampled_points_.slopes);
    multiply(known, factor_);
  }
  append(known.in_domain, reduced_places_);
  multiply(known, level_factor_);
  return known;
}

template class SizingField<2>;
template class SizingField<3>;

}  // namespace pnpbs
