// SPDX-License-Identifier: BSD-3-Clause
// TetGen reader (.poly and .smesh, https://wias-berlin.de/software/tetgen/fformats.html): vertices,
// facets, holes, regions. A facet consists of polygons that do not lie inside each other.
#include "formats/polygons.hpp"
#include "formats/surface_formats.hpp"

namespace pnpbs {

namespace {

class FacetParser {
 public:
  FacetParser(TextFields& fields, const VertexSection<3>& vertices, SurfaceTriangles& surface)
      : fields_(fields), vertices_(vertices), surface_(surface) {}

  void parse(TetGenFormat format) {
    begin_section(fields_, "facets");
    const std::int64_t count = read_count(fields_, "facets");
    has_markers_ = read_optional(fields_, "the number of boundary markers", 1) > 0;
    read_lines(fields_, count, "facets", [&] {
      if (format == TetGenFormat::poly) {
        read_facet();
      } else {
        read_corners();
        add(read_tag());
      }
    });
  }

 private:
  void read_facet() {
    const std::int64_t polygons = read_count(fields_, "polygons");
    if (polygons == 0) fields_.fail("the facet has no polygon");
    if (read_optional(fields_, "the number of holes", kMaxHoles) > 0)
      fields_.fail("the facet has holes: divide it into polygons without holes");
    const std::int32_t tag = read_tag();
    read_lines(fields_, polygons, "polygons", [&] {
      read_corners();
      add(tag);
    });
  }

  // Reads the corners of a polygon, which may continue in further lines.
  void read_corners() {
    corners_.clear();
    const std::int64_t count = read_count(fields_, "corners");
    for (std::int64_t i = 0; i < count; ++i) {
      if (fields_.rest_of_line().empty() && !fields_.next_line())
        fields_.fail("the file ends after " + part_of(i, count, "corners"));
      corners_.push_back(static_cast<std::int32_t>(read_vertex(fields_, vertices_)));
    }
  }

  // Reads the marker of a facet. 0 means that it has none.
  std::int32_t read_tag() {
    const std::int32_t marker = has_markers_ ? fields_.tag("a boundary marker") : 0;
    return marker == 0 ? 1 : marker;
  }

  void add(std::int32_t tag) {
    if (const auto problem = add_polygon(surface_, corners_, tag); !problem.empty())
      fields_.fail(problem);
  }

  static constexpr std::int64_t kMaxHoles = 1'000'000;

  TextFields& fields_;
  const VertexSection<3>& vertices_;
  SurfaceTriangles& surface_;
  bool has_markers_ = false;
  std::vector<std::int32_t> corners_;
};

std::vector<Point<3>> points(const std::vector<double>& coordinates) {
  std::vector<Point<3>> result;
  for (std::size_t i = 0; i < coordinates.size(); i += 3)
    result.push_back({coordinates[i], coordinates[i + 1], coordinates[i + 2]});
  return result;
}

void add_regions(const RegionSection<3>& regions, const std::string& file,
                 SurfaceTriangles& surface) {
  const std::vector<Point<3>> all = points(regions.points);
  for (std::size_t k = 0; k < all.size(); ++k)
    surface.regions.push_back({all[k], file + ": " + regions.names[k], regions.tags[k]});
  if (const auto warning = warning_of_skipped(regions.skipped, file))
    surface.warnings.push_back(*warning);
}

}  // namespace

SurfaceTriangles parse_tetgen(std::string_view text, const std::string& name, TetGenFormat format,
                              const std::function<NodeFile()>& node_file) {
  expect_text(text, name, format == TetGenFormat::poly ? ".poly" : ".smesh");
  TextFields fields(text, name);
  const VertexSection<3> vertices = read_vertices<3>(fields, node_file);
  if (vertices.count() > kMaxVertices) fields.fail(kTooManyVertices);
  SurfaceTriangles surface;
  surface.divides = true;
  surface.vertices = points(vertices.coordinates);
  FacetParser(fields, vertices, surface).parse(format);
  surface.holes = points(read_holes<3>(fields));
  add_regions(read_regions<3>(fields), name, surface);
  return surface;
}

}  // namespace pnpbs
