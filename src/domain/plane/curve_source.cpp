// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/curve_source.hpp"

#include "base/error.hpp"

namespace pnpbs {

namespace {

std::string prefix(const CurveSource& source) {
  if (source.kind != CurveSource::Kind::graph) {
    return "curve " + std::to_string(source.number) + ", ";
  }
  return source.number == 0 ? "" : "graph " + std::to_string(source.number) + ", ";
}

}  // namespace

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
    return prefix(*this) + "vertex " + std::to_string(first_number + point_number(point));
  if (point == 0) return prefix(*this) + "begin";
  if (ends_at(point)) return prefix(*this) + "end";
  return prefix(*this) + "t = " + number_text(parameters[static_cast<std::size_t>(point)]);
}

std::string CurveSource::segment_name(std::int64_t segment) const {
  return segments_name(segment, segment);
}

std::string CurveSource::segments_name(std::int64_t first, std::int64_t last) const {
  if (kind == Kind::smooth) return "curve " + std::to_string(number);
  const std::int64_t from = first_number + segment_number(first);
  if (first == last) return prefix(*this) + "segment " + std::to_string(from);
  // Segments that were reordered do not have consecutive numbers.
  const char* const until = segment_numbers.empty() ? " to " : " and on to ";
  return prefix(*this) + "segments " + std::to_string(from) + until +
         std::to_string(first_number + segment_number(last));
}

}  // namespace pnpbs
