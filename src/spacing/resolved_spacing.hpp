// SPDX-License-Identifier: BSD-3-Clause
// A spacing that resolves the shape of a body: held down to half the thickness of a wall, to three
// quarters of a gap's width, and where the sides of an edge are too near to each other; growing
// from there by at most g per unit of length.
#pragma once

#include <memory>

#include "domain/node_limit.hpp"
#include "domain/volume/volume_domain.hpp"
#include "spacing/growth_sources.hpp"
#include "spacing/spacing.hpp"

namespace pnpbs {

class ResolvedSpacing : public Spacing<3> {
 public:
  // The domain, checked, is looked at here alone. d is asked on the surfaces, at the same points on
  // all ranks. Throws Error(ErrorKind::spacing) if they needed more nodes than the limit allows.
  // Collective.
  ResolvedSpacing(std::shared_ptr<const Spacing<3>> raw, const VolumeDomain& domain, double growth,
                  const NodeLimit& limit);

  void evaluate(std::int64_t n, const Point<3>* x, double* d) const override;
  KnownValues<3> known_values() const override { return raw_->known_values(); }

 private:
  std::shared_ptr<const Spacing<3>> raw_;
  GrowthSources<3> sources_;
};

}  // namespace pnpbs
