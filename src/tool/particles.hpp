// SPDX-License-Identifier: BSD-3-Clause
// Volumes of nodes, and particles that fill the domain, with their statistics.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "tool/arguments.hpp"
#include "tool/centred_nodes.hpp"
#include "tool/density.hpp"
#include "tool/library.hpp"
#include "tool/ranks.hpp"
#include "tool/spacing.hpp"

namespace pnpbs::tool {

// Statistics of the volumes of all nodes or particles.
struct VolumeFigures {
  int dimension;  // volumes are areas if it is 2
  double total;
  // Statistics of the volume over d^dimension, with d at the node. Not finite if there are no
  // nodes.
  double mean, min, max;
  std::optional<double> mass{};  // total mass, if there is a density
};

// Reduces the volumes of this rank's nodes, with d at these nodes, over all ranks. The figures are
// on the first rank, where they do not depend on the number of ranks; the others get zeros.
// Collective.
VolumeFigures volume_figures(int dimension, std::span<const double> volumes,
                             std::span<const double> spacing, const Ranks& ranks);

// Builds the Voronoi cells of the nodes, and adds their volumes as the field "volume" to the files
// of the placement, and with a density the fields "density" and "mass". dimension: that of the
// elements. Returns the figures as above. Collective. Throws Failure.
VolumeFigures add_volumes(pnpbs_placement placement, int dimension,
                          const std::optional<Density>& density, pnpbs_context context,
                          const Ranks& ranks);

// Statistics of the particles of all ranks.
struct ParticleFigures {
  std::int64_t count, outermost, left_out, moved;
  double closest;  // distance of the closest pair over d; infinity if none is near
  bool of_wall;    // particles of a wall around the domain
};

// The matter that nodes represent, on request: particles, or the volumes of nodes, which are then
// also written to the files of the placement.
struct Matter {
  Particles particles;
  std::optional<ParticleFigures> figures;
  std::optional<VolumeFigures> volumes;

  // `body` is the domain that the particles fill. Collective. Throws Failure.
  Matter(const Arguments& arguments, const std::optional<Density>& density, int dimension,
         pnpbs_placement placement, pnpbs_domain body, pnpbs_context context, const Ranks& ranks);

 private:
  void make_particles(const std::optional<Density>& density, const CentredNodes& centred,
                      pnpbs_placement placement, pnpbs_domain body, pnpbs_context context,
                      const Ranks& ranks);
};

// The domains from which particles are made (see centred_nodes.hpp).
struct ParticleDomains {
  Domain filled;  // that the nodes fill: the matter without a margin along its boundary
  Domain wall;    // the matter, for walls only

  // Builds the domains for this body, and enlarges the bubbles as required. The spacing must
  // outlive the domains. Local. Throws Failure.
  void make(const Arguments& arguments, Spacing& spacing, pnpbs_domain body, int dimension,
            pnpbs_context context);
};

}  // namespace pnpbs::tool
