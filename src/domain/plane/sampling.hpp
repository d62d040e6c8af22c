// SPDX-License-Identifier: BSD-3-Clause
// Dense polylines through smooth curves.
#pragma once

#include <vector>

#include "domain/plane/curve_source.hpp"

namespace pnpbs {

struct CurveSamples {
  std::vector<double> parameters;
  std::vector<Point<2>> points;
};

// Largest turn from chord to chord, in radians: a chord then keeps within 8e-5 radii of its arc.
inline constexpr double kSampleTurn = 0.025;
inline constexpr std::int64_t kMinSamples = 64;

// The curve's points; throws Error(ErrorKind::argument) if one is not finite. `name` is for
// messages, here and below.
std::vector<Point<2>> curve_points(const CurveFunction& curve,
                                   const std::vector<double>& parameters, const std::string& name);

// Samples of a general curve, halved until it turns little from chord to chord; kinks are
// approached to 1e-6 of the curve's extent. Throws Error if the callback does, or gives what is no
// curve.
CurveSamples sample_curve(const CurveFunction& curve, double begin, double end,
                          const std::string& name);

// Samples of an arc whose function is `curve`, by angle.
CurveSamples sample_arc(const CurveFunction& curve, double begin, double end);

// The parameter between t0 and t1 at which the curve passes `point`: where it is level with it
// along the chord.
double parameter_beside(const CurveFunction& curve, double t0, double t1, const Point<2>& point);

}  // namespace pnpbs
