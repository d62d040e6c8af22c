// SPDX-License-Identifier: BSD-3-Clause
// Parts of Voronoi cells in a triangle on a sphere about the origin. The bisector planes of two
// nodes contain the origin. Therefore the central projection maps the division of the straight
// triangle to that of the spherical triangle, and only lengths and areas differ.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "sphere/sphere_geometry.hpp"
#include "voronoi/divided_element.hpp"

namespace pnpbs {

// Returns the index of a pair of sites in the row of an element. A row contains the volumes of all
// sites, then the areas of the faces between all pairs.
inline std::size_t pair_index(std::size_t sites, std::size_t a, std::size_t b) {
  if (a > b) std::swap(a, b);
  return sites + a * (2 * sites - a - 1) / 2 + (b - a - 1);
}

// Appends the row of an element. The faces between its corners are consumed.
template <int Dim, std::size_t Corners>
void append_parts(DividedElement<Dim, Corners>& divided, std::vector<double>& out) {
  const std::size_t sites = divided.sites().size(), begin = out.size();
  out.resize(begin + sites + sites * (sites - 1) / 2);
  double* const row = out.data() + begin;
  for (std::size_t a = 0; a < sites; ++a)
    for (std::size_t b = a + 1; b < sites; ++b)
      row[pair_index(sites, a, b)] = divided.face(a, b).measure();
  for (std::size_t s = 0; s < sites; ++s)
    row[s] = divided.volume(s, [&](std::size_t other) { return row[pair_index(sites, s, other)]; });
}

// Returns the arc length of a segment projected from the origin onto the unit sphere.
inline double arc_of(std::span<const Point<3>> segment) {
  return segment.size() < 2 ? 0 : arc(unit_vector(segment[0]), unit_vector(segment[1]));
}

// Appends rows like append_parts, with arcs and areas on the sphere.
class SpherePartRows {
 public:
  using Element = DividedElement<3, 3>;

  explicit SpherePartRows(double radius) : radius_(radius) {}

  void append(Element& divided, std::vector<double>& out) {
    const std::size_t sites = divided.sites().size(), begin = out.size();
    out.resize(begin + sites + sites * (sites - 1) / 2);
    double* const row = out.data() + begin;
    borders_.clear();
    for (std::size_t a = 0; a < sites; ++a)
      for (std::size_t b = a + 1; b < sites; ++b) {
        const std::span<const Point<3>> face = divided.face(a, b).points();
        row[pair_index(sites, a, b)] = radius_ * arc_of(face);
        if (face.size() == 2)
          borders_.push_back({a, b, unit_vector(face[0]), unit_vector(face[1])});
      }
    for (std::size_t s = 0; s < sites; ++s) row[s] = radius_ * radius_ * area_of(divided, s);
  }

 private:
  struct Border {
    std::size_t a, b;  // Sites on either side.
    Point<3> begin, end;
  };

  // A part is convex. Its area is the sum of triangles over its borders from a point on one of
  // them.
  double area_of(Element& divided, std::size_t site) {
    double sum = 0;
    const Point<3>* apex = nullptr;
    Point<3> first;
    const auto add = [&](const Point<3>& begin, const Point<3>& end) {
      if (!apex) apex = &(first = begin);
      sum += std::fabs(signed_area(*apex, begin, end));
    };
    for (const Border& border : borders_)
      if (border.a == site || border.b == site) add(border.begin, border.end);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::span<const Point<3>> side = divided.part_of_side(k, site).points();
      if (side.size() == 2) add(unit_vector(side[0]), unit_vector(side[1]));
    }
    return sum;
  }

  double radius_;
  std::vector<Border> borders_;  // Borders of the current element.
};

// Appends rows of elements, on a sphere of the given radius or, if it is 0, of straight elements.
template <int Dim, std::size_t Corners>
class PartRows {
 public:
  explicit PartRows(double sphere_radius) : radius_(sphere_radius), on_sphere_(sphere_radius) {}

  void append(DividedElement<Dim, Corners>& divided, std::vector<double>& out) {
    if constexpr (Dim == 3 && Corners == 3)
      if (radius_ > 0) return on_sphere_.append(divided, out);
    append_parts(divided, out);
  }

 private:
  double radius_;
  SpherePartRows on_sphere_;
};

}  // namespace pnpbs
