// SPDX-License-Identifier: BSD-3-Clause
// Particles of matter that fill a body: made of nodes that were placed somewhat inside it. In rough
// and thin places these are too close to each other; there some are left out and others move.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "domain/domain.hpp"
#include "results/results.hpp"

namespace pnpbs {

// Those that a rank owns, in the order of their ids.
struct Particles {
  int dimension = 0;
  std::vector<double> x;           // [particles][dimension]
  std::vector<std::int64_t> ids;   // of the nodes that they were
  std::vector<std::int32_t> tags;  // of these, too
  std::vector<double> spacing;     // d of the bubbles
  std::vector<double> volumes;     // areas in the plane

  // Over all ranks.
  std::int64_t all = 0;
  std::int64_t left_out = 0, moved = 0;  // nodes that are none, and those that moved
  double closest = 0;  // least distance of two over the mean of their d; infinity if none are near
};

// No two are closer than kClosestPair times the mean of their d. The body has been checked. Any
// number of ranks and threads gives the same bits. Throws Error(ErrorKind::domain) if a node is not
// strictly inside the body, or if they do not fill it. Collective, and agreed.
template <int Dim>
std::unique_ptr<Particles> make_particles(Results<Dim>& results, const Domain<Dim>& body);

// 0.7 of the spacing that bubbles of 1.076 or 1.147 of it stand for (tool/centred_nodes.hpp).
template <int Dim>
inline constexpr double kClosestPair = Dim == 2 ? 0.651 : 0.611;

extern template std::unique_ptr<Particles> make_particles<2>(Results<2>&, const PlaneDomain&);
extern template std::unique_ptr<Particles> make_particles<3>(Results<3>&, const VolumeDomain&);

}  // namespace pnpbs
