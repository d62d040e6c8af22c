// SPDX-License-Identifier: BSD-3-Clause
// The effective spacing d(x): the user's spacing and all modifications by the library. A
// SizingField has value semantics; copies share immutable parts.
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

// The effective spacing of a placement or a level. Modifications apply in the order of their
// declaration below: a factor for the number of nodes, an upper bound, reductions that resolve the
// shape, a growth limit, reductions where an earlier round left unusable elements, and the factor
// of a coarser level.
template <int Dim>
class SizingField : public Spacing<Dim> {
 public:
  // Constructs a field without a source, which must not be evaluated.
  SizingField() = default;
  explicit SizingField(std::shared_ptr<const Spacing<Dim>> source) : source_(std::move(source)) {}

  // Makes the field periodic: it is evaluated in the cell only.
  void set_cell(const PeriodicCell<Dim>& cell) { cell_ = cell; }
  // Sets the function that beat() calls. Its exceptions end the evaluation, like errors of a
  // callback.
  void set_beat(std::function<void()> beat) { beat_ = std::move(beat); }
  // Calls the function of set_beat(), if any. Every evaluation and other long operations call it,
  // so that a monitor runs while levels are built. Local.
  void beat() const {
    if (beat_) beat_();
  }

  bool has_source() const { return source_ != nullptr; }
  const Spacing<Dim>& source() const { return *source_; }  // Returns the user's spacing.
  // Points where nodes found a smaller d than the samples around them had shown. The tree is
  // refined there, and checkpoints store these points.
  const SpacingHints<Dim>& undersampled_points() const { return undersampled_points_; }
  void add_undersampled_points(const SpacingHints<Dim>& places);
  void set_undersampled_points(SpacingHints<Dim> places) {
    undersampled_points_ = std::move(places);
  }

  // Returns this field for `factor` times the distance between nodes. A spacing with a growth of
  // its own keeps this growth.
  SizingField multiplied(double factor) const;
  // Sets an upper bound of d. Without it, arithmetic with d could overflow; far above the size of
  // the domain all d are equivalent. Values that are not finite are kept so that they are reported.
  void set_bound(double bound) { bound_ = bound; }
  // Reduces d at and around the sources to d_source + growth * distance.
  void resolve(std::vector<GrowthSource<Dim>> sources, double growth);
  // Limits the growth of the field with its modifications up to now. The arguments are those of
  // GrowthLimit.
  // Collective.
  void limit_growth(std::shared_ptr<const Communicator> comm,
                    std::unique_ptr<const LineOfSight<Dim>> ways, const GrowthRule<Dim>& rule,
                    const NodeLimit& limit);
  const GrowthLimit<Dim>* growth_limit() const { return growth_limit_.get(); }
  // Reduces d at and around these points, in addition to all other modifications. Replaces earlier
  // reductions of this kind. The tree is refined at these points.
  void reduce_at(const std::vector<GrowthSource<Dim>>& places, double growth);
  // Returns this field without the reductions of reduce_at().
  SizingField without_reductions() const;
  // Returns the field of a level that is coarser by this factor.
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

  void evaluate_in_cell(std::int64_t n, const Point<Dim>* x, double* d) const;

  std::shared_ptr<const Spacing<Dim>> source_;
  PeriodicCell<Dim> cell_;
  SpacingHints<Dim> undersampled_points_;
  double factor_ = 1;
  double bound_ = std::numeric_limits<double>::infinity();
  std::shared_ptr<const Sources> resolving_;
  std::shared_ptr<const GrowthLimit<Dim>> growth_limit_;
  std::shared_ptr<const Sources> reductions_;
  std::vector<GrowthSource<Dim>> reduced_places_;  // points of reductions_
  double level_factor_ = 1;
  std::function<void()> beat_;
};

extern template class SizingField<2>;
extern template class SizingField<3>;

}  // namespace pnpbs
