// SPDX-License-Identifier: BSD-3-Clause
// Pair laws: the force between two bubbles. A law is a function f(w) of w = distance / d_ij, where
// the desired distance d_ij is (d_i + d_j) / 2. Positive values repel. `range` is the w from which
// on the force is 0.
//
// Scaling of the force. If F = f(w) for every pair, equally squeezed bubbles exert the force f(w) /
// d per unit of length (in space f(w) / d^2 per unit of area), so fine regions crush coarse ones.
// With F_ij = d_ij^(Dim-1) f(w) the stress is a function of w alone, and a graded set is at rest
// when all bubbles are equally squeezed.
//
// per_length(distance, d_ij) is the force of a pair over its distance; a kernel multiplies it by
// the vector between the two nodes. acceleration_scale(d) converts the sum of the forces to an
// acceleration, in units in which fine and coarse bubbles are equally stiff.
#pragma once

#include <type_traits>

#include "method/constants.hpp"

namespace pnpbs {

// The cubic law, equation (2) of the paper (after Shimada and Gossard): repels below w = 1 and
// attracts up to 1.5. As in the paper, the force does not depend on the size of the bubbles.
struct CubicLaw {
  double k0 = 1;
  double range = method::kCubicLawRange;

  double operator()(double w) const {
    const double f = k0 * (w * w * (method::kCubicLawCube * w - method::kCubicLawSquare) +
                           method::kCubicLawConstant);
    return w <= range ? f : 0.0;
  }
  template <int Dim>
  double per_length(double distance, double desired) const {
    return (*this)(distance / desired) / distance;
  }
  template <int Dim>
  static double acceleration_scale(double d) {
    return d;
  }
};

// Returns d^(2 - Dim), the acceleration_scale of all laws with the force d_ij^(Dim-1) f(w).
template <int Dim>
double stress_free_scale(double d) {
  return Dim == 2 ? 1.0 : 1.0 / d;
}

// A linear repulsion up to a rest length slightly above the desired distance, without attraction.
// The attraction of the cubic law distorts triangles around nodes with five and seven neighbours.
// Population control maintains the density instead. This law leaves no stress.
struct LinearPush {
  double k0 = 1;
  double range = 1.06;  // rest length in desired distances

  double operator()(double w) const {
    const double f = k0 * (1.0 - w / range);
    return f > 0.0 ? f : 0.0;
  }
  // Returns d_ij^(Dim-1) f(w) / distance. The expression has a single division because divisions
  // dominate the time of the kernel.
  template <int Dim>
  double per_length(double distance, double desired) const {
    const double gap = range * desired - distance;
    double push = (k0 / range) * (gap > 0.0 ? gap : 0.0) / distance;
    for (int k = 2; k < Dim; ++k) push *= desired;
    return push;
  }
  template <int Dim>
  static double acceleration_scale(double d) {
    return stress_free_scale<Dim>(d);
  }
};

// A smooth repulsion (1 - (w / range)^2)^2 for volumes. Bubbles settle into a body-centred cubic
// lattice. A linear repulsion with the range of touching bubbles prefers close packing, and an
// attraction damages the lattice. This law leaves no stress.
struct SmoothPush {
  double k0 = 1;
  double range = 1.2;

  double operator()(double w) const {
    const double u = w / range, rest = 1.0 - u * u;
    return rest > 0.0 ? k0 * (rest * rest) : 0.0;
  }
  // Returns d_ij^(Dim-1) f(w) / distance.
  template <int Dim>
  double per_length(double distance, double desired) const {
    const double reach = range * desired, u = distance / reach;
    const double rest = 1.0 - u * u, positive = rest > 0.0 ? rest : 0.0;
    double push = k0 * (positive * positive) / distance;
    for (int k = 1; k < Dim; ++k) push *= desired;
    return push;
  }
  template <int Dim>
  static double acceleration_scale(double d) {
    return stress_free_scale<Dim>(d);
  }
};

// A law for bubbles on a surface in space, whose force is that of the plane.
template <class Law>
struct OnSurface {
  Law law;

  template <int Dim>
  double per_length(double distance, double desired) const {
    return law.template per_length<Dim - 1>(distance, desired);
  }
  template <int Dim>
  static double acceleration_scale(double d) {
    return Law::template acceleration_scale<Dim - 1>(d);
  }
};

// The law of the option law=push.
template <int Dim>
using DefaultLaw = std::conditional_t<Dim == 2, LinearPush, SmoothPush>;

}  // namespace pnpbs
