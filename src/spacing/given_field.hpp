// SPDX-License-Identifier: BSD-3-Clause
// Values at points, scattered or of a background mesh, that every rank has completely; their
// checks, and the spacing made from them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/types.hpp"
#include "spacing/spacing.hpp"
#include "sphere/stereographic_chart.hpp"

namespace pnpbs {

// A field of values at points. All ranks must have the same field.
template <int Dim, int Corners = Dim + 1>
struct GivenField {
  static constexpr int dim = Dim, corners = Corners;

  // Names of its parts in messages.
  std::string points_name = "argument coordinates", values_name = "argument d",
              elements_name = "argument corners";
  std::vector<Point<Dim>> points;
  std::vector<double> values;
  // Triangles or tetrahedra with corners in any order. The points are scattered if none exist.
  std::vector<std::array<std::int32_t, Corners>> elements;
  ErrorKind fault = ErrorKind::argument;  // the kind of errors in this field
  // true: points that no element uses are not checked, because files of meshes may contain such
  // points.
  bool only_used = false;
};

// A field on a sphere. Points are projected along the ray from the centre; elements are triangles.
using SphereField = GivenField<3, 3>;

// Throws Error(ErrorKind::spacing) unless the value is finite and greater than 0. `name` is the
// value's name in the message: "d[3]".
void require_spacing_value(const MessageText& name, double value);

// Checks the field and returns the spacing made from it. Coordinates and values must be numbers,
// elements must not be flat, scattered points at the same position must have the same value, and
// the bounding box must meet the domain's box. Throws Error(field.fault) or
// Error(ErrorKind::spacing) for the first violation.
template <int Dim>
std::shared_ptr<const LocalSpacing<Dim>> spacing_from_field(GivenField<Dim> field,
                                                            const Box<Dim>& domain);
// Returns the spacing in the chart of a sphere after the same checks, except that the field need
// not meet the domain. A warning elsewhere reports the part of the domain outside of the field.
std::shared_ptr<const LocalSpacing<2>> spacing_from_field(SphereField field,
                                                          const StereographicChart& chart);

// Returns the bounding box of all scattered points, or of the points of elements.
template <int Dim>
Box<Dim> box_of(const GivenField<Dim>& field);

// Returns a hash of points, values and elements, by which ranks can compare their fields.
template <int Dim, int Corners>
std::uint64_t hash_of(const GivenField<Dim, Corners>& field);

}  // namespace pnpbs
