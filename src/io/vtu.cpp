// SPDX-License-Identifier: BSD-3-Clause
// Writers of VTK's XML unstructured grids and of the .pvtu file that lists pieces. The arrays
// follow the XML part as raw binary data, each after its length in bytes, so they need no text
// conversion.
#include <bit>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "io/formats.hpp"
#include "io/grid_arrays.hpp"
#include "io/xml.hpp"

namespace pnpbs::io {
namespace {

// A section of the file.
struct Part {
  std::string name;
  std::vector<GridArray> arrays;
};

std::vector<Part> parts_of(const Contents& all) {
  std::vector<Part> parts{{"PointData", point_data(all)}};
  if (all.cells != Cells::nodes) parts.push_back({"CellData", cell_data(all)});
  parts.push_back({"Points", {point_array(all)}});
  parts.push_back({"Cells", {corner_array(all), cell_ends(all), cell_types(all)}});
  return parts;
}

std::string name_of(NumberType type) {
  switch (type) {
    case NumberType::real:
      return "Float64";
    case NumberType::real32:
      return "Float32";
    case NumberType::int64:
      return "Int64";
    case NumberType::int32:
      return "Int32";
    case NumberType::int8:
      return "Int8";
    case NumberType::uint8:
      return "UInt8";
  }
  return "";
}

// Returns the attribute that names the array which viewers show first.
std::string scalars_of(const Part& part) {
  if (part.name != "PointData" && part.name != "CellData") return "";
  for (const GridArray& array : part.arrays)
    if (array.name == "spacing" || (array.name == "tag" && part.name == "CellData"))
      return " Scalars=\"" + array.name + "\"";
  return "";
}

std::string declaration(const std::vector<Part>& parts) {
  std::string text;
  std::uint64_t offset = 0;
  for (const Part& part : parts) {
    text += "      <" + part.name + scalars_of(part) + ">\n";
    for (const GridArray& array : part.arrays) {
      text += "        <DataArray type=\"" + name_of(array.type) + "\" Name=\"" + array.name + "\"";
      if (array.columns > 1)
        text += " NumberOfComponents=\"" + std::to_string(array.columns) + "\"";
      text += " format=\"appended\" offset=\"" + std::to_string(offset) + "\"/>\n";
      offset += sizeof(std::uint64_t) + array.bytes();
    }
    text += "      </" + part.name + ">\n";
  }
  return text;
}

std::string opening(const std::string& type) {
  const std::string order =
      std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type + "\" version=\"1.0\" byte_order=\"" +
         order + "\" header_type=\"UInt64\">\n";
}

}  // namespace

void write_vtu(const NodeSource& nodes, SharedFile& file) {
  const std::vector<Part> parts = parts_of(nodes.contents());
  file.append_text(opening("UnstructuredGrid") +
                   "  <UnstructuredGrid>\n    <Piece NumberOfPoints=\"" +
                   std::to_string(nodes.contents().nodes) + "\" NumberOfCells=\"" +
                   std::to_string(nodes.contents().cell_count()) + "\">\n" + declaration(parts) +
                   "    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_");
  for (const Part& part : parts) {
    for (const GridArray& array : part.arrays) {
      file.append([&](Sink& sink) {
        const std::uint64_t size = array.bytes();
        if (file.is_first()) sink.bytes(&size, sizeof size);
      });
      array.write(nodes, file);
    }
  }
  file.append_text("\n  </AppendedData>\n</VTKFile>\n");
}

void write_pvtu(const std::vector<std::string>& pieces, const Contents& like, SharedFile& file) {
  std::string text = opening("PUnstructuredGrid") + "  <PUnstructuredGrid GhostLevel=\"0\">\n";
  for (const Part& part : parts_of(like)) {
    if (part.name == "Cells") continue;  // readers do not need its declaration
    text += "    <P" + part.name + scalars_of(part) + ">\n";
    for (const GridArray& array : part.arrays)
      text += "      <PDataArray type=\"" + name_of(array.type) + "\" Name=\"" + array.name +
              "\" NumberOfComponents=\"" + std::to_string(array.columns) + "\"/>\n";
    text += "    </P" + part.name + ">\n";
  }
  for (const std::string& piece : pieces)
    text += "    <Piece Source=\"" + in_xml(std::filesystem::path(piece).filename().string()) +
            "\"/>\n";
  file.append_text(text + "  </PUnstructuredGrid>\n</VTKFile>\n");
}

}  // namespace pnpbs::io
