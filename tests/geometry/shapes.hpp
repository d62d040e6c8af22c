// SPDX-License-Identifier: BSD-3-Clause
// Domains that several tests use.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "domain/plane/plane_domain.hpp"

namespace shapes {

inline constexpr double pi = std::numbers::pi;

struct Loop {
  std::vector<double> xy;
  std::int64_t count() const { return static_cast<std::int64_t>(xy.size() / 2); }
};

inline Loop rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0, x1, y0, x1, y1, x0, y1}};
}

// Returns points on a circle, counter-clockwise.
inline Loop circle(double x, double y, double radius, int count) {
  Loop loop;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * pi * i / count;
    loop.xy.push_back(x + radius * std::cos(angle));
    loop.xy.push_back(y + radius * std::sin(angle));
  }
  return loop;
}

inline void add_loop(pnpbs::PlaneDomain& domain, const Loop& loop, double corner_angle = 0,
                     pnpbs::CurveRole role = pnpbs::CurveRole::boundary) {
  domain.add_polyline(role, true, loop.count(), loop.xy.data(), nullptr, corner_angle);
}

inline void add_chain(pnpbs::PlaneDomain& domain, const std::vector<double>& xy,
                      pnpbs::CurveRole role = pnpbs::CurveRole::inner, double corner_angle = 0) {
  domain.add_polyline(role, false, static_cast<std::int64_t>(xy.size() / 2), xy.data(), nullptr,
                      corner_angle);
}

inline void add_circle(pnpbs::PlaneDomain& domain, double x, double y, double radius,
                       std::int32_t tag = 1, pnpbs::CurveRole role = pnpbs::CurveRole::boundary) {
  domain.add_arc(role, {x, y}, radius, 0, 2 * pi, tag);
}

// A planar straight-line graph that is built step by step.
struct Graph {
  std::vector<double> xy;
  std::vector<std::int32_t> vertex_tags;
  std::vector<std::int64_t> ends;
  std::vector<std::int32_t> segment_tags;
  std::vector<double> holes;
  std::int64_t first_number = 0;

  std::int64_t vertex(double x, double y, std::int32_t tag = 0) {
    xy.push_back(x);
    xy.push_back(y);
    vertex_tags.push_back(tag);
    return static_cast<std::int64_t>(vertex_tags.size()) - 1;
  }
  void segment(std::int64_t a, std::int64_t b, std::int32_t tag = 1) {
    ends.push_back(a);
    ends.push_back(b);
    segment_tags.push_back(tag);
  }
  // Adds a closed loop through new vertices.
  void loop(const Loop& points, std::int32_t tag = 1) {
    const auto first = static_cast<std::int64_t>(vertex_tags.size());
    for (std::int64_t i = 0; i < points.count(); ++i)
      vertex(points.xy[2 * i], points.xy[2 * i + 1]);
    for (std::int64_t i = 0; i < points.count(); ++i) {
      segment(first + i, first + (i + 1) % points.count(), tag);
    }
  }
  void hole(double x, double y) {
    holes.push_back(x);
    holes.push_back(y);
  }
  void add_to(pnpbs::PlaneDomain& domain) const {
    domain.add_pslg(static_cast<std::int64_t>(vertex_tags.size()), xy.data(), vertex_tags.data(),
                    static_cast<std::int64_t>(segment_tags.size()), ends.data(),
                    segment_tags.data(), static_cast<std::int64_t>(holes.size() / 2), holes.data(),
                    first_number);
  }
};

}  // namespace shapes
