// SPDX-License-Identifier: BSD-3-Clause
// XDMF 3 (https://www.xdmf.org): a small file of XML that tells what the arrays mean which lie in a
// file by HDF5 beside it, those of the .vtu file. In space, where tetrahedra and triangles are
// mixed, each cell's corners follow the number of its kind.
#include <filesystem>
#include <span>

#include "io/formats.hpp"
#include "io/grid_arrays.hpp"
#include "io/hdf5_grid.hpp"
#include "io/xml.hpp"

namespace pnpbs::io {

namespace {

constexpr std::int64_t kXdmfTriangle = 4, kXdmfTetrahedron = 6;

// The corners of `count` cells, each cell's behind the number of its kind.
void append_kind_and_corners(std::int64_t kind, const std::vector<std::int64_t>& corners,
                             std::size_t each, SharedFile& file) {
  file.append([&](Sink& sink) {
    for (std::size_t at = 0; at < corners.size(); at += each) {
      sink.bytes(&kind, sizeof kind);
      sink.array(std::span(corners).subspan(at, each));
    }
  });
}

GridArray mixed_cells(const Contents& all) {
  const auto corners = static_cast<std::size_t>(all.element_corners());
  const auto facet_corners = static_cast<std::size_t>(all.facet_corners());
  return {"cells", NumberType::int64,
          all.elements * (all.element_corners() + 1) + all.facets * (all.facet_corners() + 1), 1,
          [=](const NodeSource& nodes, SharedFile& file) {
            nodes.for_elements([&](const ElementRows& rows) {
              append_kind_and_corners(kXdmfTetrahedron, rows.corners, corners, file);
            });
            nodes.for_facets([&](const FacetRows& rows) {
              append_kind_and_corners(kXdmfTriangle, rows.corners, facet_corners, file);
            });
          }};
}

// Of cells of one kind a row for each.
GridArray uniform_cells(const Contents& all) {
  GridArray cells = corner_array(all);
  cells.columns = all.with_elements ? all.element_corners() : 1;
  cells.rows /= cells.columns;
  return cells;
}

bool is_mixed(const Contents& all) { return all.with_elements && all.dimension == 3; }

PlacedArray placed_cells(const Contents& all) {
  if (is_mixed(all)) return {"/cells", mixed_cells(all)};
  return {"/cells", uniform_cells(all), true};
}

std::vector<PlacedArray> xdmf_point_data(const Contents& all) {
  return placed_in("/point_data", point_data(all));
}

std::vector<PlacedArray> xdmf_cell_data(const Contents& all) {
  return placed_in("/cell_data", all.with_elements ? cell_data(all) : std::vector<GridArray>());
}

PlacedArray placed_points(const Contents& all) { return {"/points", point_array(all)}; }

// ------------------------------------------------------------------ the part in XML ------------

std::string number_kind(NumberType type) {
  switch (type) {
    case NumberType::real:
    case NumberType::real32:
      return "Float";
    case NumberType::int64:
    case NumberType::int32:
      return "Int";
    case NumberType::int8:
      return "Char";
    case NumberType::uint8:
      return "UChar";
  }
  return "";
}

std::string item(const std::string& heavy, const PlacedArray& placed) {
  const GridArray& array = placed.array;
  return "        <DataItem NumberType=\"" + number_kind(array.type) + "\" Precision=\"" +
         std::to_string(size_of(array.type)) + "\" Dimensions=\"" + std::to_string(array.rows) +
         (placed.columns() > 0 ? " " + std::to_string(placed.columns()) : "") +
         "\" Format=\"HDF\">" + in_xml(heavy) + ":" + placed.path + "</DataItem>\n";
}

std::string attributes(const std::string& heavy, const std::string& center,
                       const std::vector<PlacedArray>& arrays) {
  std::string text;
  for (const PlacedArray& placed : arrays)
    text += "      <Attribute Name=\"" + placed.array.name +
            "\" AttributeType=\"Scalar\" Center=\"" + center + "\">\n" + item(heavy, placed) +
            "      </Attribute>\n";
  return text;
}

std::string topology(const Contents& all) {
  const std::string kind = is_mixed(all)       ? "Mixed"
                           : all.with_elements ? "Triangle"
                                               : "Polyvertex\" NodesPerElement=\"1";
  return "      <Topology TopologyType=\"" + kind + "\" NumberOfElements=\"" +
         std::to_string(cells_of(all)) + "\">\n";
}

}  // namespace

std::string heavy_data_path(const std::string& path) {
  return std::filesystem::path(path).replace_extension("h5").string();
}

void write_xdmf(const NodeSource& nodes, SharedFile& file) {
  const Contents& all = nodes.contents();
  const std::string heavy = std::filesystem::path(heavy_data_path(file.path())).filename().string();
  file.append_text(
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n"
      "    <Grid Name=\"Grid\" GridType=\"Uniform\">\n" +
      topology(all) + item(heavy, placed_cells(all)) + "      </Topology>\n" +
      "      <Geometry GeometryType=\"XYZ\">\n" + item(heavy, placed_points(all)) +
      "      </Geometry>\n" + attributes(heavy, "Node", xdmf_point_data(all)) +
      attributes(heavy, "Cell", xdmf_cell_data(all)) + "    </Grid>\n  </Domain>\n</Xdmf>\n");
}

void write_heavy_data(const NodeSource& nodes, SharedFile& file) {
  const Contents& all = nodes.contents();
  std::vector<PlacedArray> arrays = xdmf_point_data(all);
  for (PlacedArray& array : xdmf_cell_data(all)) arrays.push_back(std::move(array));
  arrays.push_back(placed_points(all));
  arrays.push_back(placed_cells(all));
  write_by_hdf5(nodes, file, arrays, [&](hdf5::NewFile& made) {
    made.add_group("/point_data");
    if (all.with_elements) made.add_group("/cell_data");
  });
}

}  // namespace pnpbs::io
