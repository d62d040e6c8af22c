// SPDX-License-Identifier: BSD-3-Clause
// The force between two bubbles as a function of w = distance / desired distance, where the
// desired distance is (d_i + d_j) / 2. Positive pushes. `range` is the w from which on it is 0.
// per_length(distance, desired) is the force over the distance, what a kernel multiplies with the
// vector between the two.
#pragma once

namespace pnpbs {

// Equation (2) of the paper (after Shimada and Gossard): pushes below w = 1, pulls up to 1.5.
struct CubicLaw {
  double k0 = 1;
  double range = 1.5;

  double operator()(double w) const {
    const double f = k0 * (w * w * (1.25 * w - 2.375) + 1.125);
    return w <= range ? f : 0.0;
  }
  double per_length(double distance, double desired) const {
    return (*this)(distance / desired) / distance;
  }
};

// A linear push up to a rest length a little above the desired distance, no pull. Around five- and
// seven-neighbour nodes the pull of the cubic law distorts triangles; a push does not. The density
// is then held by the population control.
struct LinearPush {
  double k0 = 1;
  double range = 1.06;  // the rest length in desired distances

  double operator()(double w) const {
    const double f = k0 * (1.0 - w / range);
    return f > 0.0 ? f : 0.0;
  }
  // With one division: they are what the kernel's time goes into.
  double per_length(double distance, double desired) const {
    const double rest = range * desired;
    const double gap = rest - distance;
    return k0 * (gap > 0.0 ? gap : 0.0) / (rest * distance);
  }
};

}  // namespace pnpbs
