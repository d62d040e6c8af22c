// SPDX-License-Identifier: BSD-3-Clause
// The map from the coordinates in which nodes are placed to the coordinates of the user. It is the
// identity in the plane and in space, and a stereographic chart on a sphere.
#pragma once

#include <optional>

#include "base/types.hpp"
#include "sphere/stereographic_chart.hpp"

namespace pnpbs {

// The identity. Embedding<2> documents the functions.
template <int Dim>
class Embedding {
 public:
  static constexpr bool is_sphere() { return false; }
  static constexpr double radius() { return 0; }
  static constexpr int coordinates() { return Dim; }

  static double measured_length(const Point<Dim>&, double length) { return length; }
  static double coordinate_length(const Point<Dim>&, double length) { return length; }
  static double distance(const Point<Dim>& x, const Point<Dim>& y) {
    return pnpbs::distance<Dim>(x, y);
  }
  static Point<3> in_space(const Point<Dim>& x) { return x; }

  static double min_stretch_in(const Box<Dim>&) { return 1; }
  static double max_stretch_in(const Box<Dim>&) { return 1; }
  static bool varies_much_in(const Box<Dim>&) { return false; }
};

template <>
class Embedding<2> {
 public:
  Embedding() = default;  // Constructs the identity of the plane.
  Embedding(const StereographicChart& chart) : chart_(chart) {}

  bool is_sphere() const { return chart_.has_value(); }
  // Requires is_sphere().
  const StereographicChart& chart() const { return *chart_; }
  // Radius of the sphere; 0 in the plane.
  double radius() const { return chart_ ? chart_->radius() : 0; }
  // Returns the number of coordinates that the user gives and receives for a point.
  int coordinates() const { return chart_ ? 3 : 2; }

  // Returns the factor from a length on the sphere to a length in the chart at u. It is 1 in the
  // plane.
  double stretch(const Point<2>& u) const { return chart_ ? chart_->stretch(u) : 1; }
  // Convert a length that is short at a point, such as d, from placement coordinates to user
  // coordinates and back.
  double measured_length(const Point<2>& u, double length) const {
    return chart_ ? length / chart_->stretch(u) : length;
  }
  double coordinate_length(const Point<2>& u, double length) const {
    return chart_ ? length * chart_->stretch(u) : length;
  }
  // Returns the distance in user coordinates, which is along the great circle on a sphere.
  double distance(const Point<2>& u, const Point<2>& v) const {
    return chart_ ? chart_->distance(u, v) : pnpbs::distance<2>(u, v);
  }
  // Returns the point in space; its third coordinate is 0 in the plane.
  Point<3> in_space(const Point<2>& u) const {
    return chart_ ? chart_->on_sphere(u) : Point<3>{u[0], u[1], 0};
  }

  double min_stretch_in(const Box<2>& box) const {
    return chart_ ? chart_->min_stretch_in(box) : 1;
  }
  double max_stretch_in(const Box<2>& box) const {
    return chart_ ? chart_->max_stretch_in(box) : 1;
  }
  // Returns whether the stretch varies so much in a box that a few samples of d can miss its
  // minimum.
  bool varies_much_in(const Box<2>& box) const { return chart_ && chart_->varies_much_in(box); }

 private:
  std::optional<StereographicChart> chart_;
};

}  // namespace pnpbs
