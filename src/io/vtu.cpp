// SPDX-License-Identifier: BSD-3-Clause
// VTK's XML unstructured grid. The arrays follow the XML part as raw binary, each after its
// length in bytes, so a million nodes cost no text conversion and no copy. The .pvtu file names
// pieces of that kind. In space the facets of the boundary are cells, too, behind the elements.
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
constexpr std::uint8_t vtk_tetrahedron = 10;

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

// The same of the elements, so many values each.
template <typename Value>
Array of_elements(const std::string& type, const std::string& name, const Contents& all,
                  std::vector<Value> ElementRows::*member, int values) {
  return {type, name, 1, bytes_of<Value>(all.elements, values),
          [member](const NodeSource& nodes, SharedFile& file) {
            nodes.for_elements([&](const ElementRows& rows) {
              file.append([&](Sink& sink) { sink.array(std::span<const Value>(rows.*member)); });
            });
          }};
}

// An array of the elements, and behind it, in space, that of the boundary's facets.
template <typename Value>
Array with_facets(const Array& elements, const Contents& all, std::vector<Value> FacetRows::*member,
                  int values) {
  if (all.dimension == 2) return elements;
  Array both = elements;
  both.bytes += bytes_of<Value>(all.facets, values);
  both.write = [first = elements.write, member](const NodeSource& nodes, SharedFile& file) {
    first(nodes, file);
    nodes.for_facets([&](const FacetRows& rows) {
      file.append([&](Sink& sink) { sink.array(std::span<const Value>(rows.*member)); });
    });
  };
  return both;
}

Array points(const Contents& all) {
  return {"Float64", "Points", 3, bytes_of<double>(all.nodes, 3),
          [dimension = static_cast<std::size_t>(all.dimension)](const NodeSource& nodes,
                                                                SharedFile& file) {
            nodes.for_nodes([&](const NodeRows& rows) {
              file.append([&](Sink& sink) {
                for (std::size_t i = 0; i < rows.ids.size(); ++i) {
                  std::array<double, 3> point{};
                  std::copy_n(&rows.x[dimension * i], dimension, point.data());
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

std::int64_t cells_of(const Contents& all) {
  if (!all.with_elements) return all.nodes;
  return all.elements + (all.dimension == 3 ? all.facets : 0);
}

// The numbers of the cells' corners, where each cell ends in them, and its type.
Part element_cells(const Contents& all) {
  const int corners = all.element_corners(), facet_corners = all.facet_corners();
  const auto end = [=, elements = all.elements](std::int64_t i) {
    const std::int64_t before = std::min(i + 1, elements);
    return corners * before + facet_corners * (i + 1 - before);
  };
  const auto type = [elements = all.dimension == 3 ? all.elements : 0](std::int64_t i) {
    return i < elements ? vtk_tetrahedron : vtk_triangle;
  };
  return {"Cells",
          {with_facets(of_elements("Int64", "connectivity", all, &ElementRows::corners, corners),
                       all, &FacetRows::corners, facet_corners),
           computed<std::int64_t>("Int64", "offsets", cells_of(all), end),
           computed<std::uint8_t>("UInt8", "types", cells_of(all), type)}};
}

Part vertex_cells(const Contents& all) {
  return {
      "Cells",
      {computed<std::int64_t>("Int64", "connectivity", all.nodes, [](std::int64_t i) { return i; }),
       computed<std::int64_t>("Int64", "offsets", all.nodes, [](std::int64_t i) { return i + 1; }),
       computed<std::uint8_t>("UInt8", "types", all.nodes,
                              [](std::int64_t) { return vtk_vertex; })}};
}

// In space, elements have the tag 0.
Part cell_data(const Contents& all) {
  Part data{"CellData",
            {with_facets(of_elements("Float32", "quality", all, &ElementRows::quality, 1), all,
                         &FacetRows::quality, 1)}};
  if (all.dimension == 3)
    data.arrays.push_back(
        with_facets(computed<std::int32_t>("Int32", "tag", all.elements,
                                           [](std::int64_t) { return std::int32_t{0}; }),
                    all, &FacetRows::tags, 1));
  return data;
}

std::vector<Part> parts_of(const Contents& all) {
  std::vector<Part> parts{{"PointData",
                           {of_nodes("Int64", "id", all, &NodeRows::ids),
                            of_nodes("Int32", "tag", all, &NodeRows::tags),
                            of_nodes("Float64", "spacing", all, &NodeRows::spacing)}}};
  if (all.is_piece)
    parts[0].arrays.push_back(of_nodes("UInt8", "vtkGhostType", all, &NodeRows::ghosts));
  if (all.with_elements) parts.push_back(cell_data(all));
  parts.push_back({"Points", {points(all)}});
  parts.push_back(all.with_elements ? element_cells(all) : vertex_cells(all));
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
  file.append_text(opening("UnstructuredGrid") +
                   "  <UnstructuredGrid>\n    <Piece NumberOfPoints=\"" +
                   std::to_string(nodes.contents().nodes) + "\" NumberOfCells=\"" +
                   std::to_string(cells_of(nodes.contents())) + "\">\n" + declaration(parts) +
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

void write_pvtu(const std::vector<std::string>& pieces, int dimension, bool elements,
                SharedFile& file) {
  std::string text = opening("PUnstructuredGrid") + "  <PUnstructuredGrid GhostLevel=\"0\">\n";
  Contents declared;  // nothing, but with all the arrays that pieces have
  declared.dimension = dimension;
  declared.with_elements = elements;
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
