// SPDX-License-Identifier: BSD-3-Clause
// Particles that fill a body, made of nodes that were placed half a spacing inside it. In rough and
// thin parts they are too close to each other, where some are left out and others are moved.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "domain/domain.hpp"
#include "results/results.hpp"

namespace pnpbs {

// The particles that a rank owns, in the order of their ids.
struct Particles {
  int dimension = 0;
  std::vector<double> x;           // [particles][dimension]
  std::vector<std::int64_t> ids;   // Ids of the nodes they were made of.
  std::vector<std::int32_t> tags;  // Tags of these nodes.
  std::vector<double> spacing;     // d of the bubbles.
  std::vector<double> volumes;     // Areas in the plane.

  // Totals over all ranks.
  std::int64_t all = 0;
  std::int64_t left_out = 0, moved = 0;  // Nodes that are left out, and particles that moved.
  // Smallest distance of a pair, or infinity if none is near. [mean d of the pair]
  double closest = 0;
};

// Returns particles with distances of at least kClosestPair times the mean of their d. The body
// must have been checked. The result is bitwise equal for any number of ranks and threads. Throws
// Error(ErrorKind::domain) if a node is not strictly inside the body, or if the nodes do not fill
// it. Collective. If one rank throws, all ranks throw.
template <int Dim>
std::unique_ptr<Particles> make_particles(Results<Dim>& results, const Domain<Dim>& body);

// Smallest distance of a pair of particles. [mean d of the pair] It is 0.7 particle spacings,
// because d of the bubbles is 1.076 (plane) or 1.147 (space) particle spacings
// (tool/centred_nodes.hpp).
template <int Dim>
inline constexpr double kClosestPair = Dim == 2 ? 0.651 : 0.611;

extern template std::unique_ptr<Particles> make_particles<2>(Results<2>&, const PlaneDomain&);
extern template std::unique_ptr<Particles> make_particles<3>(Results<3>&, const VolumeDomain&);

}  // namespace pnpbs
