// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/curve_source.hpp"

#include "base/error.hpp"

namespace pnpbs {

std::string CurveSource::name_prefix() const {
  if (number < 0) return "a side of the periodic cell, ";
  if (kind != Kind::graph) return "curve " + std::to_string(number) + ", ";
  return number == 0 ? "" : "graph " + std::to_string(number) + ", ";
}

std::int64_t CurveSource::segment_count() const {
  if (kind == Kind::graph) return static_cast<std::int64_t>(segment_ends.size());
  const auto count = static_cast<std::int64_t>(points.size());
  return closed ? count : count - 1;
}

std::array<std::int64_t, 2> CurveSource::ends(std::int64_t segment) const {
  if (kind == Kind::graph) return segment_ends[static_cast<std::size_t>(segment)];
  const std::int64_t next = segment + 1;
  return {segment, next == static_cast<std::int64_t>(points.size()) ? 0 : next};
}

std::int32_t CurveSource::segment_tag(std::int64_t segment) const {
  return kind == Kind::smooth ? tags[0] : tags[static_cast<std::size_t>(segment)];
}

std::int64_t CurveSource::point_number(std::int64_t point) const {
  return point_numbers.empty() ? point : point_numbers[static_cast<std::size_t>(point)];
}

std::int64_t CurveSource::segment_number(std::int64_t segment) const {
  return segment_numbers.empty() ? segment : segment_numbers[static_cast<std::size_t>(segment)];
}

bool CurveSource::ends_at(std::int64_t point) const {
  if (kind == Kind::graph || closed) return false;
  return point == 0 || point + 1 == static_cast<std::int64_t>(points.size());
}

std::string CurveSource::point_name(std::int64_t point) const {
  if (kind != Kind::smooth)
    return name_prefix() + "vertex " + std::to_string(first_number + point_number(point));
  if (point == 0) return name_prefix() + "begin";
  if (ends_at(point)) return name_prefix() + "end";
  return name_prefix() + "t = " + number_text(parameters[static_cast<std::size_t>(point)]);
}

std::string CurveSource::segment_name(std::int64_t segment) const {
  return segments_name(segment, segment);
}

std::string CurveSource::segments_name(std::int64_t first, std::int64_t last) const {
  if (kind == Kind::smooth) return "curve " + std::to_string(number);
  return chain_name(name_prefix(), shown_segment_number(first), shown_segment_number(last),
                    !segment_numbers.empty());
}

std::int64_t CurveSource::shown_segment_number(std::int64_t segment) const {
  return first_number + segment_number(segment);
}

std::string chain_name(const std::string& prefix, std::int64_t from, std::int64_t until,
                       bool reordered) {
  if (from == until) return prefix + "segment " + std::to_string(from);
  return prefix + "segments " + std::to_string(from) + (reordered ? " and on to " : " to ") +
         std::to_string(until);
}

}  // namespace pnpbs
