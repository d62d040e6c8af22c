// SPDX-License-Identifier: BSD-3-Clause
// The spacing as it counts: as given, no larger than makes sense or, if the user wants it so, than
// resolves the shape, or with its growth limited, because the user wants that or because nodes
// could not follow d as given.
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

// The lattice that fills a body with even d, unless so many nodes are wanted: whole layers come in
// steps.
inline bool lattice_is_stretched(const Options& options) {
  return options.real("wanted_nodes") == 0;
}

// All functions are collective.
template <int Dim>
class EffectiveSpacing {
 public:
  // From the user's spacing.
  EffectiveSpacing(std::shared_ptr<const Communicator> comm,
                   std::shared_ptr<const Domain<Dim>> domain, const SizingField<Dim>& spacing,
                   const Options& options)
      : comm_(std::move(comm)), domain_(std::move(domain)), spacing_(spacing), options_(options) {}

  // No larger than makes sense, and with so many nodes as are wanted, by an estimate whose error
  // `count_factor` corrects.
  SizingField<Dim> effective_spacing(const Settings& settings, double count_factor = 1) const;
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

// Adds places at which nodes came upon more than the samples of d had told of it. Collective.
void add_undersampled_points(const UndersampledSpacing& found, const Communicator& comm,
                             const VolumeDomain& domain, SizingField<3>& spacing);

// Is it steeper than nodes can follow?
template <int Dim>
bool too_steep(const SteepestGrowth<Dim>& steepest);
template <int Dim>
Warning warning_of_growth(const SteepestGrowth<Dim>& steepest, double growth_limit);

}  // namespace pnpbs
