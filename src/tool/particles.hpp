// SPDX-License-Identifier: BSD-3-Clause
// The nodes of a run as particles that fill its domain, in figures.
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

// Over all nodes, or particles.
struct VolumeFigures {
  int dimension;  // volumes are areas if it is 2
  double total;
  // Of the volume over d^dimension, with d at the node. Not finite without nodes.
  double mean, min, max;
  std::optional<double> mass{};  // of all, if there is a density
};

// Of those of this rank, with these d. Returns the figures on the first rank, which are the same
// for any number of ranks; zeros on the others. Collective.
VolumeFigures volume_figures(int dimension, std::span<const double> volumes,
                             std::span<const double> spacing, const Ranks& ranks);

// Makes the Voronoi cells of the nodes, and adds their volumes as the field "volume" to what files
// of the placement will have, and with a density the fields of that. dimension: of the elements.
// Figures as above. Collective. Throws Failure.
VolumeFigures add_volumes(pnpbs_placement placement, int dimension,
                          const std::optional<Density>& density, pnpbs_context context,
                          const Ranks& ranks);

// Of all ranks.
struct ParticleFigures {
  std::int64_t count, outermost, left_out, moved;
  double closest;  // pair, over d; infinity if none is near
  bool of_wall;    // around the domain
};

// What nodes stand for, if the user wants to know: particles, or their volumes, which files of the
// placement then have, too.
struct Matter {
  Particles particles;
  std::optional<ParticleFigures> figures;
  std::optional<VolumeFigures> volumes;

  // body: of particles. Collective. Throws Failure.
  Matter(const Arguments& arguments, const std::optional<Density>& density, int dimension,
         pnpbs_placement placement, pnpbs_domain body, pnpbs_context context, const Ranks& ranks);

 private:
  void make_particles(const std::optional<Density>& density, const CentredNodes& centred,
                      pnpbs_placement placement, pnpbs_domain body, pnpbs_context context,
                      const Ranks& ranks);
};

// The domains of particles: see centred_nodes.hpp.
struct ParticleDomains {
  Domain filled;  // by the nodes: what is left of their matter some way inside
  Domain wall;    // the matter, of walls alone

  // Of this body, and makes the bubbles as large as they need to be. The spacing must outlive the
  // domains. Local. Throws Failure.
  void make(const Arguments& arguments, Spacing& spacing, pnpbs_domain body, int dimension,
            pnpbs_context context);
};

}  // namespace pnpbs::tool
