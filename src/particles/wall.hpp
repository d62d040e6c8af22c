// SPDX-License-Identifier: BSD-3-Clause
// Keeps particles off the wall of the body that they fill.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "particles/known_particles.hpp"
#include "particles/near_nodes.hpp"
#include "shape/signed_distance.hpp"

namespace pnpbs {

template <int Dim>
class Wall {
 public:
  // `outermost`: of the owned ones. The body must outlive it. Throws Error(ErrorKind::domain) if a
  // particle is not strictly inside. Collective, and agreed.
  Wall(const Communicator& comm, const SignedDistance<Dim>& body,
       const KnownParticles<Dim>& particles, std::span<const char> outermost);

  // Where particle i goes that would be at `to`: there, or as deep below the wall as it must be. It
  // stays where it is if that would not be inside. Any thread may ask.
  Point<Dim> held_off(std::int64_t i, const Point<Dim>& from, Point<Dim> to) const;

 private:
  const SignedDistance<Dim>& body_;
  std::vector<double> depths_;  // the least ones, of owned particles
};

extern template class Wall<2>;
extern template class Wall<3>;

}  // namespace pnpbs
