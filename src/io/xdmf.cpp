// SPDX-License-Identifier: BSD-3-Clause
// XDMF 3 writer (https://www.xdmf.org): a small XML file that describes arrays in an HDF5 file
// beside it. They are the arrays of a .vtu file. Points of the plane have two coordinates, so that
// DOLFINx recognises a plane mesh.
#include <filesystem>

#include "io/formats.hpp"
#include "io/grid_arrays.hpp"
#include "io/hdf5_grid.hpp"
#include "io/xml.hpp"

namespace pnpbs::io {

namespace {

// Returns the corners with one row for each cell.
PlacedArray placed_cells(const Contents& all) {
  GridArray cells = corner_array(all);
  cells.columns = all.cell_nodes();
  cells.rows /= cells.columns;
  return {"/cells", std::move(cells), true};
}

std::vector<PlacedArray> xdmf_point_data(const Contents& all) {
  return placed_in("/point_data", point_data(all));
}

std::vector<PlacedArray> xdmf_cell_data(const Contents& all) {
  return placed_in("/cell_data", cell_data(all));
}

PlacedArray placed_points(const Contents& all) {
  return {"/points", point_array(all, all.coordinates)};
}

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

// Returns the XDMF type. Vectors may have any number of components; VTK's reader does not accept
// matrices.
std::string kind_of_attribute(int components) { return components == 1 ? "Scalar" : "Vector"; }

std::string attributes(const std::string& heavy, const std::string& center,
                       const std::vector<PlacedArray>& arrays) {
  std::string text;
  for (const PlacedArray& placed : arrays)
    text += "      <Attribute Name=\"" + placed.array.name + "\" AttributeType=\"" +
            kind_of_attribute(placed.array.columns) + "\" Center=\"" + center + "\">\n" +
            item(heavy, placed) + "      </Attribute>\n";
  return text;
}

std::string topology(const Contents& all) {
  const char* const kinds[] = {"", "Polyvertex\" NodesPerElement=\"1",
                               "Polyline\" NodesPerElement=\"2", "Triangle", "Tetrahedron"};
  return std::string("      <Topology TopologyType=\"") + kinds[all.cell_nodes()] +
         "\" NumberOfElements=\"" + std::to_string(all.cell_count()) + "\">\n";
}

}  // namespace

std::string heavy_data_path(const std::string& path) {
  return std::filesystem::path(path).replace_extension("h5").string();
}

// Writes the XML file. DOLFINx finds grids by name and takes the first attribute as the tags of
// facets. PyVista requires a time.
void write_xdmf(const NodeSource& nodes, SharedFile& file) {
  const Contents& all = nodes.contents();
  const std::string heavy = std::filesystem::path(heavy_data_path(file.path())).filename().string();
  file.append_text(
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n    <Grid Name=\"" +
      std::string(all.is_beside ? "facets" : "mesh") +
      "\" GridType=\"Uniform\">\n      <Time Value=\"0\"/>\n" + topology(all) +
      item(heavy, placed_cells(all)) + "      </Topology>\n" + "      <Geometry GeometryType=\"" +
      (all.coordinates == 2 ? "XY" : "XYZ") + "\">\n" + item(heavy, placed_points(all)) +
      "      </Geometry>\n" + attributes(heavy, "Cell", xdmf_cell_data(all)) +
      attributes(heavy, "Node", xdmf_point_data(all)) + "    </Grid>\n  </Domain>\n</Xdmf>\n");
}

void write_heavy_data(const NodeSource& nodes, SharedFile& file) {
  const Contents& all = nodes.contents();
  std::vector<PlacedArray> arrays = xdmf_point_data(all);
  for (PlacedArray& array : xdmf_cell_data(all)) arrays.push_back(std::move(array));
  arrays.push_back(placed_points(all));
  arrays.push_back(placed_cells(all));
  write_by_hdf5(nodes, file, arrays, [&](hdf5::NewFile& made) {
    made.add_group("/point_data");
    if (all.cells != Cells::nodes) made.add_group("/cell_data");
  });
}

}  // namespace pnpbs::io
