// SPDX-License-Identifier: BSD-3-Clause
// Keeps particles away from the wall of the body that they fill.
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
  // Computes the least depth of each particle. The owned particles with `outermost` set may not
  // approach the wall further. The others may not come nearer to it, relative to d, than the
  // nearest of these. The body must outlive this object. Throws Error(ErrorKind::domain) if a
  // particle is not strictly inside. Collective. If one rank throws, all ranks throw.
  Wall(const Communicator& comm, const SignedDistance<Dim>& body,
       const KnownParticles<Dim>& particles, std::span<const char> outermost);

  // Returns the position of particle i if it moves from `from` to `to`: `to`, or the point at its
  // least depth below the wall. Returns `from` if that is not inside. Several threads may call it
  // at the same time.
  Point<Dim> kept_off_wall(std::int64_t i, const Point<Dim>& from, Point<Dim> to) const;

 private:
  const SignedDistance<Dim>& body_;
  std::vector<double> least_depths_;  // One per owned particle.
};

extern template class Wall<2>;
extern template class Wall<3>;

}  // namespace pnpbs
