// SPDX-License-Identifier: BSD-3-Clause
// The geometry that a field transfer depends on: the plane, space, or a sphere.
#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "base/space_vectors.hpp"
#include "results/nodal_values.hpp"
#include "spacing/nodal_patch.hpp"
#include "spacing/patch_images.hpp"
#include "spacing/sphere_patch.hpp"
#include "sphere/sphere_geometry.hpp"
#include "transfer/quadratic_fits.hpp"
#include "transfer/sphere_fits.hpp"

namespace pnpbs {

template <int Dim>
struct FlatSpace {
  static constexpr int kDim = Dim, kIn = Dim;
  using Data = Patch<Dim>;
  using Searched = NodalPatch<Dim>;
  using Fits = QuadraticFits<Dim>;

  explicit FlatSpace(const Results<Dim>& results) : cell(results.level().nodes.cell) {}
  Data patch(Results<Dim>& results) const { return patch_of(results); }
  void add_images(Data& patch) const { pnpbs::add_images(patch, cell); }
  // Returns the point of a periodic cell that x is an image of.
  Point<Dim> in_cell(const Point<Dim>& x) const { return cell.in_cell(x); }
  Searched searched(Data patch) const { return Searched(std::move(patch)); }
  Point<Dim> position(const Results<Dim>& results, std::int64_t node) const {
    return results.level().nodes.position(node);
  }

  // Return the size of a triangle or a tetrahedron.
  double measure(const std::array<Point<2>, 3>& c) const {
    return std::fabs((c[1][0] - c[0][0]) * (c[2][1] - c[0][1]) -
                     (c[1][1] - c[0][1]) * (c[2][0] - c[0][0])) /
           2;
  }
  double measure(const std::array<Point<3>, 3>& c) const {
    const Point<3> normal = cross(difference(c[1], c[0]), difference(c[2], c[0]));
    return std::sqrt(dot(normal, normal)) / 2;
  }
  double measure(const std::array<Point<3>, 4>& c) const {
    const Point<3> normal = cross(difference(c[1], c[0]), difference(c[2], c[0]));
    return std::fabs(dot(normal, difference(c[3], c[0]))) / 6;
  }

  PeriodicCell<Dim> cell;
};

struct SphereSpace {
  static constexpr int kDim = 2, kIn = 3;
  using Data = Patch<2, 3>;
  using Searched = SpherePatch;
  using Fits = SphereFits;

  explicit SphereSpace(const Results<2>& results) : radius(results.sphere_radius()) {}
  Data patch(Results<2>& results) const { return sphere_patch_of(results); }
  void add_images(Data&) const {}
  Point<3> in_cell(const Point<3>& x) const { return x; }
  Searched searched(Data patch) const { return Searched(std::move(patch), radius); }
  Point<3> position(const Results<2>& results, std::int64_t node) const {
    return results.point_in_space(node);
  }

  double measure(const std::array<Point<3>, 3>& c) const {
    const double area = signed_area(unit_vector(c[0]), unit_vector(c[1]), unit_vector(c[2]));
    return radius * radius * std::fabs(area);
  }

  double radius;
};

}  // namespace pnpbs
