// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/given_field.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/mixed_hash.hpp"
#include "base/point_text.hpp"
#include "domain/given_values.hpp"
#include "predicates/plane.hpp"
#include "predicates/space.hpp"
#include "spacing/beside_domain.hpp"
#include "spacing/cloud_spacing.hpp"
#include "spacing/mesh_spacing.hpp"

namespace pnpbs {

using given_values::indexed;

void require_spacing_value(const std::string& name, double value) {
  if (!std::isfinite(value) || value <= 0)
    throw Error(ErrorKind::spacing, name + " = " + number_text(value) +
                                        ": the spacing must be finite and greater than 0");
}

namespace {

int turn(const std::array<Point<2>, 3>& x) { return orientation(x[0], x[1], x[2]); }
int turn(const std::array<Point<3>, 4>& x) { return orientation(x[0], x[1], x[2], x[3]); }

template <int Dim>
std::vector<bool> points_that_count(const GivenField<Dim>& field) {
  const bool all = field.elements.empty() || !field.only_used;
  std::vector<bool> count(field.points.size(), all);
  if (all) return count;
  for (const auto& element : field.elements)
    for (const std::int32_t i : element) count[static_cast<std::size_t>(i)] = true;
  return count;
}

template <int Dim>
void check_points(const GivenField<Dim>& field) {
  const std::vector<bool> counts = points_that_count(field);
  for (std::size_t i = 0; i < field.points.size(); ++i) {
    if (!counts[i]) continue;
    const auto at = static_cast<std::int64_t>(i);
    const Point<Dim>& x = field.points[i];
    if (!is_usable(x))
      throw Error(field.fault, indexed(field.points_name, at) + " is " + point_text(x) +
                                   ", expected numbers between -1e60 and 1e60");
    const double value = field.values[i];
    if (!std::isfinite(value) || value <= 0)
      require_spacing_value(indexed(field.values_name, at) + " at " + point_text(x), value);
  }
}

template <int Dim>
void check_elements(const GivenField<Dim>& field) {
  for (std::size_t e = 0; e < field.elements.size(); ++e) {
    std::array<Point<Dim>, Dim + 1> corners;
    for (std::size_t k = 0; k <= Dim; ++k)
      corners[k] = field.points[static_cast<std::size_t>(field.elements[e][k])];
    if (turn(corners) != 0) continue;
    std::string places;
    for (const Point<Dim>& corner : corners)
      places += (places.empty() ? "" : ", ") + point_text(corner);
    throw Error(field.fault, indexed(field.elements_name, static_cast<std::int64_t>(e)) + ": the " +
                                 (Dim == 2 ? "triangle" : "tetrahedron") + " with corners at " +
                                 places + " is flat");
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
  if (field.points.empty())
    throw Error(field.fault, field.points_name + ": there is no point, expected at least 1");
  check_points(field);
  check_elements(field);
  require_meeting_boxes(field.points_name, box_of(field), domain);
  if (field.elements.empty()) return std::make_shared<CloudSpacing<Dim>>(field);
  return std::make_shared<MeshSpacing<Dim>>(field);
}

template <int Dim>
std::uint64_t hash_of(const GivenField<Dim>& field) {
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

}  // namespace pnpbs
