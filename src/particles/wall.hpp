// SPDX-License-Identifier: BSD-3-Clause
// Keeps particles off the wall of the body that they fill.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "particles/known_particles.hpp"
#include "shape/signed_distance.hpp"

namespace pnpbs {

template <int Dim>
class Wall {
 public:
  // `outermost`: which of the owned ones are; these may come no nearer to the wall than they are,
  // and all others no nearer, over d, than the nearest of these. The body must outlive it. Throws
  // Error(ErrorKind::domain) if a particle is not strictly inside. Collective, and agreed.
  Wall(const Communicator& comm, const SignedDistance<Dim>& body,
       const KnownParticles<Dim>& particles, std::span<const char> outermost);

  // Where particle i goes that would be at `to`: there, or as deep below the wall as it must be. It
  // stays where it is if that would not be inside. Any thread may ask.
  Point<Dim> held_off(std::int64_t i, const Point<Dim>& from, Point<Dim> to) const;

 private:
  const SignedDistance<Dim>& body_;
  std::vector<double> least_depths_;  // of owned particles
};

extern template class Wall<2>;
extern template class Wall<3>;

}  // namespace pnpbs
