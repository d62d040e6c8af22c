// SPDX-License-Identifier: BSD-3-Clause
// VTK's XML unstructured grid. The arrays follow the XML part as raw binary, each after its
// length in bytes, so a million nodes cost no text conversion and no copy. The .pvtu file names
// pieces of that kind.
#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "io/formats.hpp"

namespace pnpbs::io {
namespace {

constexpr std::uint8_t vtk_vertex = 1;
constexpr std::uint8_t vtk_triangle = 5;

struct Array {
  std::string type, name;
  int components;
  std::uint64_t bytes;               // of all ranks
  std::function<void(Sink&)> write;  // this rank's
};

// An array whose values are computed one by one while they are written.
template <typename Value, typename At>
Array computed(const std::string& type, const std::string& name, const RankSpan& span, At at,
               int components = 1) {
  return {type, name, components,
          static_cast<std::uint64_t>(span.total * components) * sizeof(Value),
          [count = span.count * components, at](Sink& sink) {
            for (std::int64_t i = 0; i < count; ++i) {
              const Value value = at(static_cast<std::size_t>(i));
              sink.bytes(&value, sizeof value);
            }
          }};
}

template <typename Value>
Array stored(const std::string& type, const std::string& name, const RankSpan& span,
             const std::vector<Value>& values, int components = 1) {
  return {type, name, 1, static_cast<std::uint64_t>(span.total * components) * sizeof(Value),
          [&values](Sink& sink) { sink.array(std::span<const Value>(values)); }};
}

Array points(const NodeBlock& nodes) {
  return computed<double>(
      "Float64", "Points", nodes.nodes,
      [&nodes](std::size_t k) { return k % 3 == 2 ? 0.0 : nodes.xy[k / 3 * 2 + k % 3]; }, 3);
}

struct Part {
  std::string name;
  std::vector<Array> arrays;
};

// What every kind of cells has: the numbers of their corners, where each cell ends in them, and
// its type.
template <std::uint8_t type>
Part cells(Array connectivity, const RankSpan& span, std::int64_t corners) {
  return {"Cells",
          {std::move(connectivity),
           computed<std::int64_t>("Int64", "offsets", span,
                                  [first = span.first, corners](std::size_t i) {
                                    return corners * (first + static_cast<std::int64_t>(i) + 1);
                                  }),
           computed<std::uint8_t>("UInt8", "types", span, [](std::size_t) { return type; })}};
}

Part triangle_cells(const NodeBlock& nodes) {
  return cells<vtk_triangle>(stored("Int64", "connectivity", nodes.triangles, nodes.corners, 3),
                             nodes.triangles, 3);
}

Part vertex_cells(const NodeBlock& nodes) {
  return cells<vtk_vertex>(computed<std::int64_t>("Int64", "connectivity", nodes.nodes,
                                                  [first = nodes.nodes.first](std::size_t i) {
                                                    return first + static_cast<std::int64_t>(i);
                                                  }),
                           nodes.nodes, 1);
}

std::vector<Part> parts_of(const NodeBlock& nodes) {
  std::vector<Part> parts{{"PointData",
                           {stored("Int64", "id", nodes.nodes, nodes.ids),
                            stored("Int32", "tag", nodes.nodes, nodes.tags),
                            stored("Float64", "spacing", nodes.nodes, nodes.spacing)}}};
  if (nodes.is_piece)
    parts[0].arrays.push_back(stored("UInt8", "vtkGhostType", nodes.nodes, nodes.ghosts));
  if (nodes.elements)
    parts.push_back({"CellData", {stored("Float32", "quality", nodes.triangles, nodes.quality)}});
  parts.push_back({"Points", {points(nodes)}});
  parts.push_back(nodes.elements ? triangle_cells(nodes) : vertex_cells(nodes));
  return parts;
}

std::string declaration(const std::vector<Part>& parts) {
  std::string text;
  std::uint64_t offset = 0;
  for (const Part& part : parts) {
    text +=
        "      <" + part.name + (part.name == "PointData" ? " Scalars=\"spacing\"" : "") + ">\n";
    for (const Array& array : part.arrays) {
      text += "        <DataArray type=\"" + array.type + "\" Name=\"" + array.name + "\"";
      if (array.components > 1)
        text += " NumberOfComponents=\"" + std::to_string(array.components) + "\"";
      text += " format=\"appended\" offset=\"" + std::to_string(offset) + "\"/>\n";
      offset += sizeof array.bytes + array.bytes;
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

// A file's name may have letters that mean something in XML.
std::string in_xml(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

}  // namespace

void write_vtu(const NodeBlock& nodes, SharedFile& file) {
  const std::vector<Part> parts = parts_of(nodes);
  const std::int64_t cells = nodes.elements ? nodes.triangles.total : nodes.nodes.total;
  file.append_text(opening("UnstructuredGrid") +
                   "  <UnstructuredGrid>\n    <Piece NumberOfPoints=\"" +
                   std::to_string(nodes.nodes.total) + "\" NumberOfCells=\"" +
                   std::to_string(cells) + "\">\n" + declaration(parts) +
                   "    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_");
  for (const Part& part : parts) {
    for (const Array& array : part.arrays) {
      file.append([&](Sink& sink) {
        if (file.is_first()) sink.bytes(&array.bytes, sizeof array.bytes);
        array.write(sink);
      });
    }
  }
  file.append_text("\n  </AppendedData>\n</VTKFile>\n");
}

void write_pvtu(const std::vector<std::string>& pieces, bool elements, SharedFile& file) {
  std::string text = opening("PUnstructuredGrid") + "  <PUnstructuredGrid GhostLevel=\"0\">\n";
  NodeBlock declared;  // empty, but with all the arrays that pieces have
  declared.elements = elements;
  declared.is_piece = true;
  for (const Part& part : parts_of(declared)) {
    if (part.name == "Cells") continue;  // a reader knows what they look like
    text += "    <P" + part.name + (part.name == "PointData" ? " Scalars=\"spacing\"" : "") + ">\n";
    for (const Array& array : part.arrays)
      text += "      <PDataArray type=\"" + array.type + "\" Name=\"" + array.name +
              "\" NumberOfComponents=\"" + std::to_string(array.components) + "\"/>\n";
    text += "    </P" + part.name + ">\n";
  }
  for (const std::string& piece : pieces)
    text += "    <Piece Source=\"" + in_xml(std::filesystem::path(piece).filename().string()) +
            "\"/>\n";
  file.append_text(text + "  </PUnstructuredGrid>\n</VTKFile>\n");
}

}  // namespace pnpbs::io
