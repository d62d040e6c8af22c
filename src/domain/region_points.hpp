// SPDX-License-Identifier: BSD-3-Clause
// Applies region points to the parts into which curves, or surfaces in space, divide the domain.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/index.hpp"
#include "base/point_text.hpp"
#include "base/warning.hpp"
#include "domain/domain_base.hpp"

namespace pnpbs {

// Returns the name and the position of a region point for messages.
template <int Dim>
MessageText name_and_position(const RegionPoint<Dim>& point) {
  return point.name + " at " + point_text(point.point);
}

// Marks the parts that contain holes as outside. part_of(k) returns the part in which point k lies.
// Throws Error(ErrorKind::domain) if a hole lies outside, or if nothing of the domain is left.
template <int Dim, class PartOf>
void remove_holes(const std::vector<RegionPoint<Dim>>& points, const PartOf& part_of,
                  std::vector<char>& inside, std::vector<Warning>& warnings) {
  std::vector<const RegionPoint<Dim>*> hole_in(inside.size());
  std::vector<MessageText> left_out;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!points[k].is_hole()) continue;
    const std::size_t part = index(part_of(k));
    if (!inside[part]) {
      const MessageText problem = name_and_position<Dim>(points[k]) + " lies outside the domain";
      if (!points[k].from_file) reject_domain(problem);
      left_out.push_back(problem);
      continue;
    }
    if (hole_in[part])
      warnings.emplace_back(
          WarningCode::region_points,
          name_and_position<Dim>(points[k]) + " lies in the same region as " + hole_in[part]->name,
          1);
    else
      hole_in[part] = &points[k];
  }
  if (!left_out.empty())
    warnings.emplace_back(WarningCode::region_points, "left out: " + list_text(left_out),
                          std::ssize(left_out));
  for (std::size_t part = 0; part < inside.size(); ++part)
    if (hole_in[part]) inside[part] = 0;
  if (std::find(inside.begin(), inside.end(), 1) == inside.end())
    reject_domain("the holes leave nothing of the domain");
}

// Returns the tag of each part, 0 where no point gives one; empty if no point does. `inside` must
// already exclude the holes. Points of the user take precedence over those of files. Throws
// Error(ErrorKind::domain) for a point of the user outside the domain or with a conflicting tag.
template <int Dim, class PartOf>
std::vector<std::int32_t> tags_of_parts(const std::vector<RegionPoint<Dim>>& points,
                                        const PartOf& part_of, const std::vector<char>& inside,
                                        std::vector<Warning>& warnings) {
  std::vector<const RegionPoint<Dim>*> point_in(inside.size());
  std::vector<std::int32_t> tags;
  std::vector<MessageText> left_out;
  const auto add = [&](std::size_t k) {
    const RegionPoint<Dim>& it = points[k];
    const std::size_t part = index(part_of(k));
    const RegionPoint<Dim>* other = point_in[part];
    MessageText problem;
    if (!inside[part])
      problem = name_and_position<Dim>(it) + " lies outside the domain";
    else if (other && other->tag != it.tag)
      problem = name_and_position<Dim>(it) + " has the tag " + std::to_string(it.tag) +
                ", but lies in the same region as " + name_and_position<Dim>(*other) +
                " with the tag " + std::to_string(other->tag);
    if (!problem.empty() && !it.from_file) reject_domain(problem);
    if (!problem.empty()) return left_out.push_back(problem);
    point_in[part] = &it;
    tags.resize(inside.size());
    tags[part] = it.tag;
  };
  for (const bool from_file : {false, true})
    for (std::size_t k = 0; k < points.size(); ++k)
      if (!points[k].is_hole() && points[k].from_file == from_file) add(k);
  if (!left_out.empty())
    warnings.emplace_back(WarningCode::region_points, "left out: " + list_text(left_out),
                          std::ssize(left_out));
  return tags;
}

}  // namespace pnpbs
