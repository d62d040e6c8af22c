// SPDX-License-Identifier: BSD-3-Clause
// The force between two bubbles. f(w) is its law, w = distance / desired distance, where the
// desired distance d_ij is (d_i + d_j) / 2; positive pushes. `range` is the w from which on it is
// 0.
//
// Along a chain of bubbles that are squeezed alike, a coarse one is pushed by one fine neighbour
// per fine spacing: with F = f(w) for every pair, the force per length (per area in a volume) is
// f(w) / d, and fine regions crush coarse ones. With F_ij = d_ij^(Dim-1) f(w) the stress is a
// function of w alone, so a graded set is at rest where all of it is squeezed alike.
//
// per_length(distance, desired) is the pair's force over its distance, what a kernel multiplies
// with the vector between the two; acceleration_scale(d) makes the sum of these an acceleration in
// units in which fine and coarse bubbles are equally stiff.
#pragma once

#include <type_traits>

#include "method/constants.hpp"

namespace pnpbs {

// Equation (2) of the paper (after Shimada and Gossard): pushes below w = 1, pulls up to 1.5. To
// the letter, the same force for pairs of all sizes.
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

// d^(2 - Dim), the acceleration_scale of all laws whose force is d_ij^(Dim-1) f(w).
template <int Dim>
double stress_free_scale(double d) {
  return Dim == 2 ? 1.0 : 1.0 / d;
}

// A linear push up to a rest length a little above the desired distance, no pull. Around five- and
// seven-neighbour nodes the pull of the cubic law distorts triangles; a push does not. The density
// is then held by the population control. Leaves no stress.
struct LinearPush {
  double k0 = 1;
  double range = 1.06;  // the rest length in desired distances

  double operator()(double w) const {
    const double f = k0 * (1.0 - w / range);
    return f > 0.0 ? f : 0.0;
  }
  // d_ij^(Dim-1) f(w) / distance with one division: they are what the kernel's time goes into.
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

// A push that fades out smoothly, (1 - (w / range)^2)^2, for volumes: it takes body-centred cubic
// order, where a linear push that reaches no farther than touching bubbles prefers close packing,
// and a pull damages the lattice. Leaves no stress.
struct SmoothPush {
  double k0 = 1;
  double range = 1.2;

  double operator()(double w) const {
    const double u = w / range, rest = 1.0 - u * u;
    return rest > 0.0 ? k0 * (rest * rest) : 0.0;
  }
  // d_ij^(Dim-1) f(w) / distance.
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

// A law for bubbles that fill a surface in space, as it is in the plane.
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

template <int Dim>
using DefaultLaw = std::conditional_t<Dim == 2, LinearPush, SmoothPush>;

}  // namespace pnpbs
