// SPDX-License-Identifier: BSD-3-Clause
// Samples smooth curves as dense polylines.
#pragma once

#include <vector>

#include "domain/plane/curve_source.hpp"

namespace pnpbs {

// Points of a curve and their parameters.
struct CurveSamples {
  std::vector<double> parameters;
  std::vector<Point<2>> points;
};

// Largest turn from chord to chord. [radians] A chord then stays within 8e-5 radii of its arc.
inline constexpr double kSampleTurn = 0.025;
inline constexpr std::int64_t kMinSamples = 64;

// Returns points of the curve at the given parameters. Throws Error(ErrorKind::argument) if one is
// not finite. `name` is the name of the curve in messages, here and below.
std::vector<Point<2>> curve_points(const CurveFunction& curve,
                                   const std::vector<double>& parameters, const std::string& name);

// Samples a general curve; intervals are halved until the curve turns little from chord to chord.
// Kinks are approached to 1e-6 of the curve's extent. Throws Error if the callback does, if the
// curve is a single point, or if it turns too often.
CurveSamples sample_curve(const CurveFunction& curve, double begin, double end,
                          const std::string& name);

// Samples an arc, whose function is `curve`, at equal angles.
CurveSamples sample_arc(const CurveFunction& curve, double begin, double end);

// Returns the parameter between t0 and t1 at which the curve and `point` have the same projection
// onto the chord.
double parameter_beside(const CurveFunction& curve, double t0, double t1, const Point<2>& point);

}  // namespace pnpbs
