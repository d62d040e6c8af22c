// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/given_field.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "base/error.hpp"
#include "base/mixed_hash.hpp"
#include "base/point_text.hpp"
#include "base/space_vectors.hpp"
#include "domain/given_values.hpp"
#include "predicates/plane.hpp"
#include "predicates/space.hpp"
#include "spacing/mesh_spacing.hpp"
#include "spacing/outside_domain.hpp"
#include "spacing/scattered_spacing.hpp"
#include "spacing/sphere_spacing.hpp"

namespace pnpbs {

using given_values::indexed;

void require_spacing_value(const MessageText& name, double value) {
  if (!std::isfinite(value) || value <= 0)
    throw Error(ErrorKind::spacing, name + " = " + number_text(value) +
                                        ": the spacing must be finite and greater than 0");
}

namespace {

int turn(const std::array<Point<2>, 3>& x) { return orientation(x[0], x[1], x[2]); }
int turn(const std::array<Point<3>, 4>& x) { return orientation(x[0], x[1], x[2], x[3]); }
// The orientation as seen from the centre of the sphere.
int turn(const std::array<Point<3>, 3>& x) { return orientation(x[0], x[1], x[2], Point<3>{}); }

template <class Field>
std::vector<bool> points_that_count(const Field& field) {
  const bool all = field.elements.empty() || !field.only_used;
  std::vector<bool> count(field.points.size(), all);
  if (all) return count;
  for (const auto& element : field.elements)
    for (const std::int32_t i : element) count[static_cast<std::size_t>(i)] = true;
  return count;
}

template <class Field>
void check_points(const Field& field) {
  if (field.points.empty())
    throw Error(field.fault, field.points_name + ": there is no point, expected at least 1");
  const std::vector<bool> counts = points_that_count(field);
  for (std::size_t i = 0; i < field.points.size(); ++i) {
    if (!counts[i]) continue;
    const auto at = static_cast<std::int64_t>(i);
    const auto& x = field.points[i];
    if (!is_usable(x))
      throw Error(field.fault, indexed(field.points_name, at) + " is " + point_text(x) +
                                   ", expected numbers between -1e60 and 1e60");
    if (std::is_same_v<Field, SphereField> && !(length(x) > 0))
      throw Error(field.fault, indexed(field.points_name, at) + " = " + point_text(x) +
                                   " has no direction from the centre of the sphere");
    const double value = field.values[i];
    if (!std::isfinite(value) || value <= 0)
      require_spacing_value(indexed(field.values_name, at) + " at " + point_text(x), value);
  }
}

template <int Dim, int Corners>
void check_elements(const GivenField<Dim, Corners>& field) {
  for (std::size_t e = 0; e < field.elements.size(); ++e) {
    std::array<Point<Dim>, Corners> corners;
    for (std::size_t k = 0; k < Corners; ++k)
      corners[k] = field.points[static_cast<std::size_t>(field.elements[e][k])];
    if (turn(corners) != 0) continue;
    MessageText corners_text;
    for (const Point<Dim>& corner : corners)
      corners_text += (corners_text.empty() ? "" : ", ") + point_text(corner);
    throw Error(field.fault, indexed(field.elements_name, static_cast<std::int64_t>(e)) + ": the " +
                                 (Corners == 3 ? "triangle" : "tetrahedron") + " with corners at " +
                                 corners_text +
                                 (Corners == Dim ? " is a part of a great circle" : " is flat"));
  }
}

}  // namespace

template <int Dim>
Box<Dim> box_of(const GivenField<Dim>& field) {
  const auto corner = [&](std::int32_t i) { return field.points[static_cast<std::size_t>(i)]; };
  const Point<Dim> first =
      field.elements.empty() ? field.points.front() : corner(field.elements.front()[0]);
  Box<Dim> box{first, first};
  if (field.elements.empty())
    for (const Point<Dim>& x : field.points) box = joined(box, {x, x});
  for (const auto& element : field.elements)
    for (const std::int32_t i : element) box = joined(box, {corner(i), corner(i)});
  return box;
}

template <int Dim>
std::shared_ptr<const LocalSpacing<Dim>> spacing_from_field(GivenField<Dim> field,
                                                            const Box<Dim>& domain) {
  check_points(field);
  check_elements(field);
  require_meeting_boxes(field.points_name, box_of(field), domain);
  if (field.elements.empty()) return std::make_shared<ScatteredSpacing<Dim>>(field);
  return std::make_shared<MeshSpacing<Dim>>(field);
}

std::shared_ptr<const LocalSpacing<2>> spacing_from_field(SphereField field,
                                                          const StereographicChart& chart) {
  check_points(field);
  const double radius = chart.radius();
  for (Point<3>& x : field.points) {
    const Point<3> direction = unit_vector(x);
    for (std::size_t k = 0; k < 3; ++k) x[k] = radius * direction[k];
  }
  check_elements(field);
  std::shared_ptr<const LocalSpacing<3>> along;
  if (field.elements.empty())
    along = std::make_shared<SphereScatteredSpacing>(field, radius);
  else
    along = std::make_shared<SphereMeshSpacing>(field, radius);
  return std::make_shared<SphereSpacing>(std::move(along), chart);
}

template <int Dim, int Corners>
std::uint64_t hash_of(const GivenField<Dim, Corners>& field) {
  std::uint64_t hash = mixed(field.points.size());
  for (const Point<Dim>& x : field.points)
    for (const double coordinate : x) hash = mixed_with(hash, coordinate);
  for (const double value : field.values) hash = mixed_with(hash, value);
  for (const auto& element : field.elements)
    for (const std::int32_t corner : element)
      hash = mixed(hash ^ static_cast<std::uint64_t>(corner));
  return hash;
}

template std::shared_ptr<const LocalSpacing<2>> spacing_from_field(GivenField<2>, const Box<2>&);
template std::shared_ptr<const LocalSpacing<3>> spacing_from_field(GivenField<3>, const Box<3>&);
template Box<2> box_of(const GivenField<2>&);
template Box<3> box_of(const GivenField<3>&);
template std::uint64_t hash_of(const GivenField<2>&);
template std::uint64_t hash_of(const GivenField<3>&);
template std::uint64_t hash_of(const SphereField&);

}  // namespace pnpbs
