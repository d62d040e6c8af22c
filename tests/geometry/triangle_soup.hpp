// SPDX-License-Identifier: BSD-3-Clause
// Triangulated surfaces that are built step by step and added to a volume's domain.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "core/surfaces.hpp"
#include "domain/volume/volume_domain.hpp"
#include "expect_error.hpp"

namespace soups {

using P = pnpbs::Point<3>;
using pnpbs::SurfaceRole;
using pnpbs::VolumeDomain;

struct Soup {
  std::vector<double> xyz;
  std::vector<std::int64_t> corners;
  std::vector<std::int32_t> tags;

  std::int64_t vertices() const { return static_cast<std::int64_t>(xyz.size() / 3); }
  std::int64_t triangles() const { return static_cast<std::int64_t>(corners.size() / 3); }

  std::int64_t vertex(double x, double y, double z) {
    xyz.insert(xyz.end(), {x, y, z});
    return vertices() - 1;
  }
  void triangle(std::int64_t a, std::int64_t b, std::int64_t c, std::int32_t tag = 1) {
    corners.insert(corners.end(), {a, b, c});
    tags.push_back(tag);
  }
  void turn(std::int64_t t) { std::swap(corners[3 * t + 1], corners[3 * t + 2]); }
  Soup turned() const {
    Soup other = *this;
    for (std::int64_t t = 0; t < triangles(); ++t) other.turn(t);
    return other;
  }
  Soup shifted(double x, double y, double z) const {
    Soup other = *this;
    for (std::int64_t v = 0; v < vertices(); ++v) {
      other.xyz[3 * v] += x;
      other.xyz[3 * v + 1] += y;
      other.xyz[3 * v + 2] += z;
    }
    return other;
  }
  // Returns a copy in which each triangle has three vertices of its own, as in STL files.
  Soup torn() const {
    Soup other;
    for (std::int64_t t = 0; t < triangles(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const double* const x = &xyz[3 * corners[3 * t + k]];
        other.vertex(x[0], x[1], x[2]);
      }
      other.triangle(3 * t, 3 * t + 1, 3 * t + 2, tags[t]);
    }
    return other;
  }
  void add(const Soup& other) {
    const std::int64_t first = vertices();
    xyz.insert(xyz.end(), other.xyz.begin(), other.xyz.end());
    for (const std::int64_t corner : other.corners) corners.push_back(first + corner);
    tags.insert(tags.end(), other.tags.begin(), other.tags.end());
  }
  void add_to(VolumeDomain& domain, SurfaceRole role = SurfaceRole::boundary) const {
    domain.add_surface(role, vertices(), xyz.data(), triangles(), corners.data(), tags.data());
  }
};

inline Soup soup_of(const surfaces::Surface& surface) {
  Soup soup;
  for (const surfaces::Place& x : surface.nodes) {
    const P p = surface.at(x);
    soup.vertex(p[0], p[1], p[2]);
  }
  for (const surfaces::Triangle& t : surface.triangles) soup.triangle(t[0], t[1], t[2]);
  return soup;
}

inline Soup tetrahedron(const P& a, const P& b, const P& c, const P& d) {
  Soup soup;
  for (const P& x : {a, b, c, d}) soup.vertex(x[0], x[1], x[2]);
  soup.triangle(0, 2, 1);
  soup.triangle(0, 1, 3);
  soup.triangle(1, 2, 3);
  soup.triangle(2, 0, 3);
  return soup;
}

inline Soup unit_tetrahedron() { return tetrahedron({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}); }

// Returns one quadrilateral, cut in two.
inline Soup sheet(const P& a, const P& b, const P& c, const P& d) {
  Soup soup;
  for (const P& x : {a, b, c, d}) soup.vertex(x[0], x[1], x[2]);
  soup.triangle(0, 1, 2);
  soup.triangle(0, 2, 3);
  return soup;
}

inline void expect_domain_error(VolumeDomain& domain, std::initializer_list<const char*> parts) {
  expect_error(pnpbs::ErrorKind::domain, parts, [&domain] { domain.check(); });
  ck_assert(!domain.is_checked());
}

inline bool warns(const VolumeDomain& domain, const std::string& part) {
  return std::any_of(domain.warnings().begin(), domain.warnings().end(),
                     [&part](const pnpbs::Warning& warning) {
                       return warning.message.text().find(part) != std::string::npos;
                     });
}

inline void expect_near(double value, double expected, double relative) {
  ck_assert_msg(std::fabs(value - expected) <= relative * std::fabs(expected), "%.17g, not %.17g",
                value, expected);
}

}  // namespace soups
