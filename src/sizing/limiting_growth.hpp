// SPDX-License-Identifier: BSD-3-Clause
// Computes the effective spacing from the user's: bounded from above, on request fine enough to
// resolve the shape, and with limited growth, on request or because nodes could not follow d.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "base/warning.hpp"
#include "comm/communicator.hpp"
#include "domain/domain.hpp"
#include "level/undersampled_points.hpp"
#include "settings/options.hpp"
#include "settings/settings.hpp"
#include "spacing/sizing_field.hpp"
#include "spacing/steepest_growth.hpp"

namespace pnpbs {

// Returns whether the lattice that fills a body with uniform d is stretched to fit. It is not
// stretched if the option wanted_nodes is set, because whole layers change the number of nodes in
// steps.
inline bool lattice_is_stretched(const Options& options) {
  return options.real("wanted_nodes") == 0;
}

// Computes effective spacings for a domain and options. All its functions are collective.
template <int Dim>
class EffectiveSpacing {
 public:
  // `spacing` is the user's spacing. `options` must outlive this object.
  EffectiveSpacing(std::shared_ptr<const Communicator> comm,
                   std::shared_ptr<const Domain<Dim>> domain, const SizingField<Dim>& spacing,
                   const Options& options)
      : comm_(std::move(comm)), domain_(std::move(domain)), spacing_(spacing), options_(options) {
    spacing_.set_cell(domain_->cell());
  }

  // Returns the bounded spacing, scaled for the number of nodes in the option wanted_nodes if that
  // is set. This number is estimated; `count_factor` on d corrects the error of the estimate.
  SizingField<Dim> effective_spacing(const Settings& settings, double count_factor = 1) const;
  // Limits the growth of the spacing to settings.growth_limit.
  void limit_growth(SizingField<Dim>& spacing, const Settings& settings) const;

  const Communicator& comm() const { return *comm_; }
  const Domain<Dim>& domain() const { return *domain_; }
  const Options& options() const { return options_; }

 private:
  SizingField<Dim> bounded(SizingField<Dim> spacing, const Settings& settings) const;
  double factor_for(double wanted_nodes, const Settings& settings) const;

  std::shared_ptr<const Communicator> comm_;
  std::shared_ptr<const Domain<Dim>> domain_;
  SizingField<Dim> spacing_;
  const Options& options_;
};

extern template class EffectiveSpacing<2>;
extern template class EffectiveSpacing<3>;

// Adds the points where nodes found a smaller d than its samples had shown, and the fine region
// around them. Collective.
void add_undersampled_points(const UndersampledSpacing& found, const Communicator& comm,
                             const VolumeDomain& domain, SizingField<3>& spacing);

// Evaluates the spacing at these points of all ranks and adds them to the points at which the tree
// samples it. Points outside a body are ignored. The spacing is unchanged if this throws. All ranks
// must call it, and if one rank throws, all ranks throw.
template <int Dim>
void add_spacing_hints(const std::vector<Point<Dim>>& own, const Communicator& comm,
                       const Domain<Dim>& domain, SizingField<Dim>& spacing);

// Returns whether the spacing grows faster than nodes can follow.
template <int Dim>
bool too_steep(const SteepestGrowth<Dim>& steepest);
template <int Dim>
Warning warning_of_growth(const SteepestGrowth<Dim>& steepest, double growth_limit);

}  // namespace pnpbs
