// SPDX-License-Identifier: BSD-3-Clause
// Values at points, of a background mesh or scattered, that every rank gives whole: what they must
// be, and the spacing made of them.
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

template <int Dim, int Corners = Dim + 1>
struct GivenField {
  static constexpr int dim = Dim, corners = Corners;

  // What messages call its parts.
  std::string points_name = "argument coordinates", values_name = "argument d",
              elements_name = "argument corners";
  std::vector<Point<Dim>> points;
  std::vector<double> values;
  // Triangles or tetrahedra, in any order of their corners; without any the points are scattered.
  std::vector<std::array<std::int32_t, Corners>> elements;
  ErrorKind fault = ErrorKind::argument;  // what it is if a part of it is wrong
  // Points that no element has may be of any kind: files of meshes have such.
  bool only_used = false;
};

// Of points on a sphere, which are taken along the ray from its centre, and of triangles.
using SphereField = GivenField<3, 3>;

// Throws Error(ErrorKind::spacing) unless it is finite and greater than 0. `name`: "d[3]".
void require_spacing_value(const MessageText& name, double value);

// Checks the field: coordinates and values are numbers, elements are not flat, points in one place
// have one value, and what holds all of it meets the domain's box. Throws Error(field.fault) or
// Error(ErrorKind::spacing), told by the first of what is wrong.
template <int Dim>
std::shared_ptr<const LocalSpacing<Dim>> spacing_from_field(GivenField<Dim> field,
                                                            const Box<Dim>& domain);
// The same on the sphere, in its chart. It need not meet the domain: what of that is beyond is told
// in a warning.
std::shared_ptr<const LocalSpacing<2>> spacing_from_field(SphereField field,
                                                          const StereographicChart& chart);

// What of the points counts: all of a cloud, of a mesh those of its elements.
template <int Dim>
Box<Dim> box_of(const GivenField<Dim>& field);

// Of all that it holds: ranks that give the same have the same.
template <int Dim, int Corners>
std::uint64_t hash_of(const GivenField<Dim, Corners>& field);

}  // namespace pnpbs
