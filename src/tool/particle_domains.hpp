// SPDX-License-Identifier: BSD-3-Clause
// The domains of particles: see centred_nodes.hpp.
#pragma once

#include "tool/arguments.hpp"
#include "tool/library.hpp"
#include "tool/spacing.hpp"

namespace pnpbs::tool {

struct ParticleDomains {
  Domain filled;  // by the nodes: what is left of their matter some way inside
  Domain wall;    // the matter, of walls alone

  // Of this body, and makes the bubbles as large as they need to be. The spacing must outlive the
  // domains. Local. Throws Failure.
  void make(const Arguments& arguments, Spacing& spacing, pnpbs_domain body, int dimension,
            pnpbs_context context);
};

}  // namespace pnpbs::tool
