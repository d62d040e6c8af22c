// SPDX-License-Identifier: BSD-3-Clause
#include "tool/particle_domains.hpp"

#include "tool/centred_nodes.hpp"

namespace pnpbs::tool {

void ParticleDomains::make(const Arguments& arguments, Spacing& spacing, pnpbs_domain body,
                           int dimension, pnpbs_context context) {
  const CentredNodes nodes = centred_nodes(dimension);
  const auto add = [&](Domain& domain, const Band& band) {
    check(pnpbs_domain_create(context, dimension, domain.out()), context);
    spacing.add_band(domain, body, band, context);
  };
  if (arguments.in_walls) {
    const int layers = arguments.wall_layers.value_or(default_wall_layers);
    add(filled, nodes.in_wall(layers));
    add(wall, nodes.wall(layers));
  } else {
    add(filled, nodes.inside());
  }
  spacing.multiply(nodes.bubbles);
}

}  // namespace pnpbs::tool
