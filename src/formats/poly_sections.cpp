// SPDX-License-Identifier: BSD-3-Clause
#include "formats/poly_sections.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/point_text.hpp"

namespace pnpbs {

namespace {

constexpr std::array kAxes{"x", "y", "z"};

template <int Dim>
void read_point(TextFields& fields, std::vector<double>& coordinates) {
  for (std::size_t k = 0; k < Dim; ++k) coordinates.push_back(fields.coordinate(kAxes[k]));
}

template <int Dim>
void read_vertex_number(TextFields& fields, VertexSection<Dim>& vertices) {
  const std::int64_t number = fields.integer("a vertex number");
  if (vertices.tags.empty()) {
    if (number != 0 && number != 1) {
      fields.fail("the first vertex is " + std::to_string(number) + ", expected 0 or 1");
    }
    vertices.first_number = number;
  }
  const std::int64_t expected = vertices.first_number + vertices.count();
  if (number != expected) {
    fields.fail("found vertex " + std::to_string(number) + ", expected vertex " +
                std::to_string(expected));
  }
}

template <int Dim>
VertexSection<Dim> read_vertex_section(TextFields& fields) {
  const std::string dimension_here = std::to_string(Dim);
  VertexSection<Dim> vertices;
  begin_section(fields, "vertices");
  const std::int64_t count = read_count(fields, "vertices");
  const std::int64_t dimension = read_optional(fields, "the dimension " + dimension_here, 3, Dim);
  if (dimension != Dim) {
    fields.fail("found dimension " + std::to_string(dimension) + ", expected " + dimension_here);
  }
  const std::int64_t attributes = read_optional(fields, "the number of attributes", 1000);
  const std::int64_t markers = read_optional(fields, "the number of boundary markers", 1);
  read_lines(fields, count, "vertices", [&] {
    read_vertex_number(fields, vertices);
    read_point<Dim>(fields, vertices.coordinates);
    for (std::int64_t a = 0; a < attributes; ++a) fields.required("an attribute");
    vertices.tags.push_back(markers > 0 ? fields.tag("a boundary marker") : 0);
  });
  return vertices;
}

// Returns the tag in a regional attribute, 0 if the attribute is empty, or nothing if it is not a
// tag. Triangle writes attributes with a decimal point.
std::optional<std::int32_t> tag_in(std::string_view attribute) {
  double value = 0;
  if (attribute.empty()) return 0;
  if (!parse_field(attribute, value) || std::trunc(value) != value ||
      std::abs(value) > std::numeric_limits<std::int32_t>::max())
    return {};
  return static_cast<std::int32_t>(value);
}

template <int Dim>
void read_region(TextFields& fields, RegionSection<Dim>& regions) {
  const std::string name = "region " + std::to_string(fields.integer("a region number"));
  std::vector<double> point;
  read_point<Dim>(fields, point);
  const std::string_view attribute = fields.next().value_or("");
  const std::optional<std::int32_t> tag = tag_in(attribute);
  if (!tag) regions.skipped.push_back(shown_field(attribute) + " of " + name);
  if (tag.value_or(0) == 0) return;
  regions.points.insert(regions.points.end(), point.begin(), point.end());
  regions.tags.push_back(*tag);
  regions.names.push_back(name);
}

}  // namespace

void begin_section(TextFields& fields, const std::string& what) {
  if (!fields.next_line()) fields.fail("the file ends, expected the number of " + what);
}

std::int64_t read_count(TextFields& fields, const std::string& what) {
  const std::int64_t count = fields.integer("the number of " + what);
  if (count < 0) fields.fail("the number of " + what + " is " + std::to_string(count));
  return count;
}

std::int64_t read_optional(TextFields& fields, const std::string& what, std::int64_t max,
                           std::int64_t if_missing) {
  if (fields.rest_of_line().empty()) return if_missing;
  const std::int64_t value = fields.integer(what);
  if (value < 0 || value > max) {
    fields.fail("found " + std::to_string(value) + ", expected " + what + " (0 to " +
                std::to_string(max) + ")");
  }
  return value;
}

void read_lines(TextFields& fields, std::int64_t count, const std::string& what,
                const std::function<void()>& read) {
  for (std::int64_t i = 0; i < count; ++i) {
    if (!fields.next_line()) fields.fail("the file ends after " + part_of(i, count, what));
    read();
  }
}

template <int Dim>
VertexSection<Dim> read_vertices(TextFields& fields, const std::function<NodeFile()>& node_file) {
  VertexSection<Dim> vertices = read_vertex_section<Dim>(fields);
  if (vertices.count() > 0) return vertices;
  if (!node_file) {
    fields.fail("0 vertices mean a separate .node file, which text without a file cannot have");
  }
  const NodeFile nodes = node_file();
  TextFields node_fields(nodes.text, nodes.name);
  vertices = read_vertex_section<Dim>(node_fields);
  if (vertices.count() == 0) node_fields.fail("the file holds no vertices");
  if (node_fields.next_line()) node_fields.fail("found more lines than expected");
  return vertices;
}

template <int Dim>
std::int64_t read_vertex(TextFields& fields, const VertexSection<Dim>& vertices) {
  const std::int64_t number = fields.integer("a vertex number");
  const std::int64_t end = vertices.first_number + vertices.count();
  if (number < vertices.first_number || number >= end) {
    fields.fail("there is no vertex " + std::to_string(number) + ", expected " +
                std::to_string(vertices.first_number) + " to " + std::to_string(end - 1));
  }
  return number - vertices.first_number;
}

template <int Dim>
std::vector<double> read_holes(TextFields& fields) {
  std::vector<double> holes;
  begin_section(fields, "holes");
  const std::int64_t count = read_count(fields, "holes");
  read_lines(fields, count, "holes", [&] {
    fields.integer("a hole number");
    read_point<Dim>(fields, holes);
  });
  return holes;
}

template <int Dim>
RegionSection<Dim> read_regions(TextFields& fields) {
  RegionSection<Dim> regions;
  if (!fields.next_line()) return regions;
  const std::int64_t count = read_count(fields, "regions");
  read_lines(fields, count, "regions", [&] { read_region(fields, regions); });
  if (fields.next_line()) fields.fail("found more lines than expected");
  return regions;
}

std::optional<Warning> warning_of_skipped(const std::vector<std::string>& skipped,
                                          const std::string& file) {
  if (skipped.empty()) return std::nullopt;
  return Warning(WarningCode::region_points,
                 file +
                     ": regional attributes that are no integers, and so no tags, are skipped: " +
                     list_text(skipped, 5),
                 std::ssize(skipped));
}

template VertexSection<2> read_vertices<2>(TextFields&, const std::function<NodeFile()>&);
template VertexSection<3> read_vertices<3>(TextFields&, const std::function<NodeFile()>&);
template std::int64_t read_vertex<2>(TextFields&, const VertexSection<2>&);
template std::int64_t read_vertex<3>(TextFields&, const VertexSection<3>&);
template std::vector<double> read_holes<2>(TextFields&);
template std::vector<double> read_holes<3>(TextFields&);
template RegionSection<2> read_regions<2>(TextFields&);
template RegionSection<3> read_regions<3>(TextFields&);

}  // namespace pnpbs
