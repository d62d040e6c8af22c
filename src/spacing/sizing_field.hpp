// SPDX-License-Identifier: BSD-3-Clause
// d(x) as it counts: the user's spacing, and everything that the library makes of it. A value,
// whose copies share what does not change.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "spacing/growth_limit.hpp"
#include "spacing/growth_sources.hpp"
#include "spacing/spacing.hpp"

namespace pnpbs {

// Its parts apply in the order in which they are declared below: a factor for a wanted number of
// nodes, an upper bound, reductions that resolve the shape, a growth limit, reductions where an
// earlier round left elements that cannot be used, and the factor of a coarser level.
template <int Dim>
class SizingField : public Spacing<Dim> {
 public:
  // Has no source yet, and cannot be evaluated.
  SizingField() = default;
  explicit SizingField(std::shared_ptr<const Spacing<Dim>> source) : source_(std::move(source)) {}

  // Sets what beat() calls. What it throws ends the evaluation, as an error of a callback does.
  void set_beat(std::function<void()> beat) { beat_ = std::move(beat); }
  // Is called by every evaluation, and by other work that takes long where d is small: so that a
  // monitor is asked while levels are made. Local.
  void beat() const {
    if (beat_) beat_();
  }

  bool has_source() const { return source_ != nullptr; }
  const Spacing<Dim>& source() const { return *source_; }  // the user's
  // Places where nodes came upon a smaller d than the samples around had told. The tree is refined
  // there. They are part of what a checkpoint stores.
  const SpacingHints<Dim>& undersampled_points() const { return undersampled_points_; }
  void add_undersampled_points(const SpacingHints<Dim>& places);
  void set_undersampled_points(SpacingHints<Dim> places) {
    undersampled_points_ = std::move(places);
  }

  // For `factor` times the distance between nodes. A spacing with a growth of its own keeps that.
  SizingField multiplied(double factor) const;
  // Bounds d from above. Far above the size of the domain, where all d mean the same, arithmetic
  // with d would overflow. Values that are not finite stay, to be reported.
  void set_bound(double bound) { bound_ = bound; }
  // Reduces d to the values of the sources, and to what they allow around them.
  void resolve(std::vector<GrowthSource<Dim>> sources, double growth);
  // Limits the growth of what the field is so far. The arguments are those of GrowthLimit.
  // Collective.
  void limit_growth(std::shared_ptr<const Communicator> comm,
                    std::unique_ptr<const LineOfSight<Dim>> ways, const GrowthRule<Dim>& rule,
                    const NodeLimit& limit);
  const GrowthLimit<Dim>* growth_limit() const { return growth_limit_.get(); }
  // Reduces d at these places and around them, in addition to all else. The tree is refined there.
  void reduce_at(const std::vector<GrowthSource<Dim>>& places, double growth);
  // Without the places that reduce_at() was given.
  SizingField without_reductions() const;
  // Of a level that is coarser by this factor.
  SizingField coarsened(double factor) const;

  void evaluate(std::int64_t n, const Point<Dim>* x, double* d) const override;
  SpacingHints<Dim> spacing_hints() const override;
  std::optional<GivenExtent<Dim>> extent() const override { return source_->extent(); }
  void distance_to_extent(std::int64_t n, const Point<Dim>* x, double* distances) const override {
    source_->distance_to_extent(n, x, distances);
  }

 private:
  using Sources = GrowthSources<Dim>;

  static void reduce(const Sources& sources, std::int64_t n, const Point<Dim>* x, double* d);

  std::shared_ptr<const Spacing<Dim>> source_;
  SpacingHints<Dim> undersampled_points_;
  double factor_ = 1;
  double bound_ = std::numeric_limits<double>::infinity();
  std::shared_ptr<const Sources> resolving_;
  std::shared_ptr<const GrowthLimit<Dim>> growth_limit_;
  std::shared_ptr<const Sources> reductions_;
  std::vector<GrowthSource<Dim>> reduced_places_;  // of the reductions
  double level_factor_ = 1;
  std::function<void()> beat_;
};

extern template class SizingField<2>;
extern template class SizingField<3>;

}  // namespace pnpbs
