// SPDX-License-Identifier: BSD-3-Clause
// OFF reader (Geomview, http://www.geomview.org/docs/html/OFF.html), with one vertex or face per
// line. Normals and colours are skipped.
#include "formats/polygons.hpp"
#include "formats/surface_formats.hpp"
#include "formats/text_fields.hpp"

namespace pnpbs {

namespace {

// Reads the optional keyword "[ST][C][N][4][n]OFF". Throws if it has 4 or n, since vertices must
// have three coordinates. The counts may follow in the same line.
void read_keyword(TextFields& fields) {
  if (!fields.next_line()) fields.fail("the file ends, expected 'OFF'");
  TextFields ahead = fields;
  const std::string_view first = ahead.required("'OFF'");
  if (first.front() >= '0' && first.front() <= '9' && !first.ends_with("OFF")) return;
  std::string_view prefix = first;
  if (!first.ends_with("OFF")) fields.fail_found(first, "'OFF'");
  prefix.remove_suffix(3);
  if (prefix.starts_with("ST")) prefix.remove_prefix(2);
  if (prefix.starts_with("C")) prefix.remove_prefix(1);
  if (prefix.starts_with("N")) prefix.remove_prefix(1);
  if (!prefix.empty()) fields.fail_found(first, "'OFF' of vertices with 3 coordinates");
  fields = ahead;
  if (fields.rest_of_line().empty() && !fields.next_line())
    fields.fail("the file ends, expected the number of vertices");
}

std::int32_t read_corner(TextFields& fields, std::int64_t vertices) {
  const std::int64_t number = fields.integer("a vertex number");
  if (number < 0 || number >= vertices) fields.fail(no_such_vertex(number, vertices));
  return static_cast<std::int32_t>(number);
}

}  // namespace

SurfaceTriangles parse_off(std::string_view text, const std::string& name) {
  expect_text(text, name, "OFF");
  TextFields fields(text, name);
  read_keyword(fields);
  const std::int64_t vertices = read_count(fields, "vertices");
  if (vertices > kMaxVertices) fields.fail(kTooManyVertices);
  const std::int64_t faces = read_count(fields, "faces");
  SurfaceTriangles surface;
  read_lines(fields, vertices, "vertices", [&] {
    const double x = fields.coordinate("x"), y = fields.coordinate("y");
    surface.vertices.push_back({x, y, fields.coordinate("z")});
  });
  std::vector<std::int32_t> corners;
  read_lines(fields, faces, "faces", [&] {
    corners.clear();
    for (std::int64_t left = read_count(fields, "corners"); left > 0; --left)
      corners.push_back(read_corner(fields, vertices));
    if (const auto problem = add_polygon(surface, corners, 1); !problem.empty())
      fields.fail(problem);
  });
  if (fields.next_line()) fields.fail("found more lines than expected");
  return surface;
}

}  // namespace pnpbs
