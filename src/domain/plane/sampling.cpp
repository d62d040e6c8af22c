// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/sampling.hpp"

#include <algorithm>
#include <cmath>

#include "base/limits.hpp"
#include "base/point_text.hpp"
#include "geometry/plane/segments.hpp"

namespace pnpbs {

namespace {

constexpr std::size_t kMaxSamples = std::size_t{1} << 20;

double extent(const std::vector<Point<2>>& points) {
  Box<2> box{points[0], points[0]};
  for (const Point<2>& point : points) include(box, point);
  return size_of(box);
}

// Returns true if the chord ab approximates the curve, which passes through `middle`, well enough.
bool is_smooth(const Point<2>& a, const Point<2>& middle, const Point<2>& b, double whole) {
  const double first = distance<2>(a, middle), second = distance<2>(middle, b);
  const double length = first + second;
  if (length <= 1e-6 * whole) return true;
  if (length > whole / 16) return false;
  const bool even = std::fabs(first - second) <= 0.01 * length;
  if (!even && length > 1e-4 * whole) return false;
  return distance_to_segment(a, b, middle) <= kSampleTurn / 8 * length;
}

std::vector<double> equal_steps(double begin, double end, std::int64_t count) {
  std::vector<double> parameters(static_cast<std::size_t>(count) + 1);
  for (std::int64_t i = 0; i < count; ++i) {
    const double fraction = static_cast<double>(i) / static_cast<double>(count);
    parameters[static_cast<std::size_t>(i)] = begin + (end - begin) * fraction;
  }
  parameters.back() = end;
  return parameters;
}

std::vector<double> middles(const std::vector<double>& parameters, const std::vector<bool>& open) {
  std::vector<double> result;
  for (std::size_t i = 0; i + 1 < parameters.size(); ++i) {
    if (open[i]) result.push_back(0.5 * parameters[i] + 0.5 * parameters[i + 1]);
  }
  return result;
}

}  // namespace

std::vector<Point<2>> curve_points(const CurveFunction& curve,
                                   const std::vector<double>& parameters, const std::string& name) {
  std::vector<Point<2>> points(parameters.size());
  curve(static_cast<std::int64_t>(points.size()), parameters.data(), points.data());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_usable(points[i])) continue;
    throw Error(ErrorKind::argument, name + ": the callback returned " + point_text(points[i]) +
                                         " at t = " + number_text(parameters[i]));
  }
  return points;
}

CurveSamples sample_curve(const CurveFunction& curve, double begin, double end,
                          const std::string& name) {
  CurveSamples samples;
  samples.parameters = equal_steps(begin, end, kMinSamples);
  samples.points = curve_points(curve, samples.parameters, name);
  const double whole = extent(samples.points);
  if (!(whole > 0)) {
    throw Error(ErrorKind::argument, name + " is a single point, " + point_text(samples.points[0]));
  }
  // Each round is one batch: the middles of all intervals that are not yet known to be smooth.
  std::vector<bool> open(samples.points.size() - 1, true);
  while (std::find(open.begin(), open.end(), true) != open.end()) {
    const std::vector<double> new_parameters = middles(samples.parameters, open);
    const std::vector<Point<2>> new_points = curve_points(curve, new_parameters, name);
    CurveSamples finer;
    std::vector<bool> still_open;
    std::size_t next = 0;
    for (std::size_t i = 0; i < samples.points.size(); ++i) {
      finer.parameters.push_back(samples.parameters[i]);
      finer.points.push_back(samples.points[i]);
      if (i == open.size()) break;
      if (!open[i]) {
        still_open.push_back(false);
        continue;
      }
      const double t = new_parameters[next];
      const Point<2> middle = new_points[next++];
      const bool smooth = is_smooth(samples.points[i], middle, samples.points[i + 1], whole) ||
                          t == samples.parameters[i] || t == samples.parameters[i + 1];
      if (!smooth) {
        finer.parameters.push_back(t);
        finer.points.push_back(middle);
        still_open.push_back(true);
      }
      still_open.push_back(!smooth);
    }
    samples = std::move(finer);
    open = std::move(still_open);
    if (samples.points.size() > kMaxSamples) {
      throw Error(ErrorKind::argument, name + " turns too often: " + std::to_string(kMaxSamples) +
                                           " samples do not resolve it");
    }
  }
  return samples;
}

CurveSamples sample_arc(const CurveFunction& curve, double begin, double end) {
  const double wanted = std::ceil(std::fabs(end - begin) / kSampleTurn);
  CurveSamples samples;
  samples.parameters =
      equal_steps(begin, end, std::max(kMinSamples, static_cast<std::int64_t>(wanted)));
  samples.points.resize(samples.parameters.size());
  curve(static_cast<std::int64_t>(samples.points.size()), samples.parameters.data(),
        samples.points.data());
  return samples;
}

double parameter_beside(const CurveFunction& curve, double t0, double t1, const Point<2>& point) {
  constexpr int kParts = 32;
  std::vector<double> t{t0, t1};
  std::vector<Point<2>> xy(2);
  curve(2, t.data(), xy.data());
  const Point<2> chord{xy[1][0] - xy[0][0], xy[1][1] - xy[0][1]};
  const auto behind = [&](const Point<2>& p) {
    return (p[0] - point[0]) * chord[0] + (p[1] - point[1]) * chord[1] < 0;
  };
  for (int round = 0; round < 12; ++round) {
    t = equal_steps(t0, t1, kParts);
    xy.resize(t.size());
    curve(kParts + 1, t.data(), xy.data());
    int part = 0;
    while (part + 1 < kParts && behind(xy[static_cast<std::size_t>(part) + 1])) ++part;
    t0 = t[static_cast<std::size_t>(part)];
    t1 = t[static_cast<std::size_t>(part) + 1];
  }
  return t1;
}

}  // namespace pnpbs
