// SPDX-License-Identifier: BSD-3-Clause
// The nodes of a run as particles that fill its domain, in figures.
#pragma once

#include <cstdint>
#include <optional>

#include "tool/arguments.hpp"
#include "tool/centred_nodes.hpp"
#include "tool/library.hpp"
#include "tool/node_volumes.hpp"
#include "tool/ranks.hpp"

namespace pnpbs::tool {

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

}  // namespace pnpbs::tool
