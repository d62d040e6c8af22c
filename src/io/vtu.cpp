// SPDX-License-Identifier: BSD-3-Clause
// VTK's XML unstructured grid. The arrays follow the XML part as raw binary, each after its
// length in bytes, so a million nodes cost no text conversion and no copy. The .pvtu file names
// pieces of that kind.
#include <algorithm>
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
  std::uint64_t bytes;  // of all ranks
  std::function<void(const NodeSource&, SharedFile&)> write;
};

template <typename Value>
std::uint64_t bytes_of(std::int64_t count, int components) {
  return static_cast<std::uint64_t>(count * components) * sizeof(Value);
}

// An array of the nodes, as `member` of their rows has it.
template <typename Value>
Array of_nodes(const std::string& type, const std::string& name, const Contents& all,
               std::vector<Value> NodeRows::*member) {
  return {type, name, 1, bytes_of<Value>(all.nodes, 1),
          [member](const NodeSource& nodes, SharedFile& file) {
            nodes.for_nodes([&](const NodeRows& rows) {
              file.append([&](Sink& sink) { sink.array(std::span<const Value>(rows.*member)); });
            });
          }};
}

// The same of the triangles.
template <typename Value>
Array of_triangles(const std::string& type, const std::string& name, const Contents& all,
                   std::vector<Value> TriangleRows::*member, int components) {
  return {type, name, 1, bytes_of<Value>(all.triangles, components),
          [member](const NodeSource& nodes, SharedFile& file) {
            nodes.for_triangles([&](const TriangleRows& rows) {
              file.append([&](Sink& sink) { sink.array(std::span<const Value>(rows.*member)); });
            });
          }};
}

Array points(const Contents& all) {
  return {"Float64", "Points", 3, bytes_of<double>(all.nodes, 3),
          [](const NodeSource& nodes, SharedFile& file) {
            nodes.for_nodes([&](const NodeRows& rows) {
              file.append([&](Sink& sink) {
                for (std::size_t i = 0; i < rows.ids.size(); ++i) {
                  const std::array<double, 3> point{rows.xy[2 * i], rows.xy[2 * i + 1], 0};
                  sink.bytes(point.data(), sizeof point);
                }
              });
            });
          }};
}

// Values that follow from their number alone; the ranks take turns.
template <typename Value, typename At>
Array computed(const std::string& type, const std::string& name, std::int64_t count, At at) {
  return {type, name, 1, bytes_of<Value>(count, 1),
          [count, at](const NodeSource&, SharedFile& file) {
            constexpr std::int64_t part = 1 << 16;
            for (std::int64_t begin = 0; begin < count; begin += part * file.ranks().size()) {
              const std::int64_t first = begin + part * file.ranks().rank();
              file.append([&](Sink& sink) {
                for (std::int64_t i = first; i < std::min(first + part, count); ++i) {
                  const Value value = at(i);
                  sink.bytes(&value, sizeof value);
                }
              });
            }
          }};
}

struct Part {
  std::string name;
  std::vector<Array> arrays;
};

// What every kind of cells has: the numbers of their corners, where each cell ends in them, and
// its type.
template <std::uint8_t type>
Part cells(Array connectivity, std::int64_t count, std::int64_t corners) {
  return {"Cells",
          {std::move(connectivity),
           computed<std::int64_t>("Int64", "offsets", count,
                                  [corners](std::int64_t i) { return corners * (i + 1); }),
           computed<std::uint8_t>("UInt8", "types", count, [](std::int64_t) { return type; })}};
}

Part triangle_cells(const Contents& all) {
  return cells<vtk_triangle>(of_triangles("Int64", "connectivity", all, &TriangleRows::corners, 3),
                             all.triangles, 3);
}

Part vertex_cells(const Contents& all) {
  return cells<vtk_vertex>(
      computed<std::int64_t>("Int64", "connectivity", all.nodes, [](std::int64_t i) { return i; }),
      all.nodes, 1);
}

std::vector<Part> parts_of(const Contents& all) {
  std::vector<Part> parts{{"PointData",
                           {of_nodes("Int64", "id", all, &NodeRows::ids),
                            of_nodes("Int32", "tag", all, &NodeRows::tags),
                            of_nodes("Float64", "spacing", all, &NodeRows::spacing)}}};
  if (all.is_piece)
    parts[0].arrays.push_back(of_nodes("UInt8", "vtkGhostType", all, &NodeRows::ghosts));
  if (all.elements)
    parts.push_back(
        {"CellData", {of_triangles("Float32", "quality", all, &TriangleRows::quality, 1)}});
  parts.push_back({"Points", {points(all)}});
  parts.push_back(all.elements ? triangle_cells(all) : vertex_cells(all));
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

void write_vtu(const NodeSource& nodes, SharedFile& file) {
  const std::vector<Part> parts = parts_of(nodes.contents());
  const std::int64_t cells =
      nodes.contents().elements ? nodes.contents().triangles : nodes.contents().nodes;
  file.append_text(opening("UnstructuredGrid") +
                   "  <UnstructuredGrid>\n    <Piece NumberOfPoints=\"" +
                   std::to_string(nodes.contents().nodes) + "\" NumberOfCells=\"" +
                   std::to_string(cells) + "\">\n" + declaration(parts) +
                   "    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_");
  for (const Part& part : parts) {
    for (const Array& array : part.arrays) {
      file.append([&](Sink& sink) {
        if (file.is_first()) sink.bytes(&array.bytes, sizeof array.bytes);
      });
      array.write(nodes, file);
    }
  }
  file.append_text("\n  </AppendedData>\n</VTKFile>\n");
}

void write_pvtu(const std::vector<std::string>& pieces, bool elements, SharedFile& file) {
  std::string text = opening("PUnstructuredGrid") + "  <PUnstructuredGrid GhostLevel=\"0\">\n";
  Contents declared;  // nothing, but with all the arrays that pieces have
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
