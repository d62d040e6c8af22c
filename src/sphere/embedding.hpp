// SPDX-License-Identifier: BSD-3-Clause
// How the coordinates that nodes are placed in relate to the space in which users measure. In the
// plane and in space they are the same. On a sphere they are those of a stereographic chart.
#pragma once

#include <optional>

#include "base/types.hpp"
#include "sphere/stereographic_chart.hpp"

namespace pnpbs {

// The identity, which all functions of Embedding<2> compute in the plane as well.
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

  static double least_stretch_in(const Box<Dim>&) { return 1; }
  static double most_stretch_in(const Box<Dim>&) { return 1; }
  static bool varies_much_in(const Box<Dim>&) { return false; }
};

template <>
class Embedding<2> {
 public:
  Embedding() = default;  // of the plane
  Embedding(const StereographicChart& chart) : chart_(chart) {}

  bool is_sphere() const { return chart_.has_value(); }
  // Requires is_sphere().
  const StereographicChart& chart() const { return *chart_; }
  double radius() const { return chart_ ? chart_->radius() : 0; }  // of the sphere
  // Number of coordinates that users give and get of a point.
  int coordinates() const { return chart_ ? 3 : 2; }

  // A length where nodes are placed over the same one as users measure it.
  double stretch(const Point<2>& u) const { return chart_ ? chart_->stretch(u) : 1; }
  // Converts a short length at a point, such as d, from where nodes are placed to where users
  // measure it, and back.
  double measured_length(const Point<2>& u, double length) const {
    return chart_ ? length / chart_->stretch(u) : length;
  }
  double coordinate_length(const Point<2>& u, double length) const {
    return chart_ ? length * chart_->stretch(u) : length;
  }
  // Distance as users measure it.
  double distance(const Point<2>& u, const Point<2>& v) const {
    return chart_ ? chart_->distance(u, v) : pnpbs::distance<2>(u, v);
  }
  // The point in space; in the plane its third coordinate is 0.
  Point<3> in_space(const Point<2>& u) const {
    return chart_ ? chart_->on_sphere(u) : Point<3>{u[0], u[1], 0};
  }

  double least_stretch_in(const Box<2>& box) const {
    return chart_ ? chart_->least_stretch_in(box) : 1;
  }
  double most_stretch_in(const Box<2>& box) const {
    return chart_ ? chart_->most_stretch_in(box) : 1;
  }
  // Whether the stretch differs so much in a box that a few samples of d miss its least value.
  bool varies_much_in(const Box<2>& box) const { return chart_ && chart_->varies_much_in(box); }

 private:
  std::optional<StereographicChart> chart_;
};

}  // namespace pnpbs
