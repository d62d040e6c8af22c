// SPDX-License-Identifier: BSD-3-Clause
// VTK's XML unstructured grid. The arrays follow the XML part as raw binary, each after its
// length in bytes, so a million nodes cost no text conversion and no copy.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
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
  std::uint64_t bytes;
  std::function<void(Sink&)> write;
};

// An array whose values are computed one by one while they are written.
template <typename Value, typename At>
Array computed(const std::string& type, const std::string& name, std::size_t count, At at) {
  return {type, name, 1, count * sizeof(Value), [count, at](Sink& sink) {
            for (std::size_t i = 0; i < count; ++i) {
              const Value value = at(i);
              sink.bytes(&value, sizeof value);
            }
          }};
}

template <typename Value>
Array stored(const std::string& type, const std::string& name, const std::vector<Value>& values) {
  return {type, name, 1, values.size() * sizeof(Value),
          [&values](Sink& sink) { sink.array(std::span<const Value>(values)); }};
}

Array points(const NodeSet& nodes) {
  return {"Float64", "Points", 3, nodes.size() * 3 * sizeof(double), [&nodes](Sink& sink) {
            for (std::size_t i = 0; i < nodes.size(); ++i) {
              const std::array<double, 3> point{nodes.xy[2 * i], nodes.xy[2 * i + 1], 0};
              sink.bytes(point.data(), sizeof point);
            }
          }};
}

// 2 r_in / R: 1 for an equilateral triangle, 0 for a flat one.
float quality(const NodeSet& nodes, std::size_t triangle) {
  std::array<const double*, 3> p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = &nodes.xy[2 * nodes.triangles[3 * triangle + k]];
  const auto side = [&](int i, int j) { return std::hypot(p[j][0] - p[i][0], p[j][1] - p[i][1]); };
  const double a = side(0, 1), b = side(1, 2), c = side(2, 0);
  const double twice_area =
      (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
  // In ratios, so that no product leaves the range of doubles.
  const double height = twice_area / a;
  const double value = 4 * (height / b) * (height / c) * (a / (a + b + c));
  return std::isfinite(value) ? static_cast<float>(value) : 0.0F;
}

struct Part {
  std::string name;
  std::vector<Array> arrays;
};

Part triangle_cells(const NodeSet& nodes) {
  const std::size_t count = nodes.triangle_count();
  return {
      "Cells",
      {stored("Int64", "connectivity", nodes.triangles),
       computed<std::int64_t>("Int64", "offsets", count, [](std::size_t i) { return 3 * (i + 1); }),
       computed<std::uint8_t>("UInt8", "types", count, [](std::size_t) { return vtk_triangle; })}};
}

Part vertex_cells(const NodeSet& nodes) {
  const std::size_t count = nodes.size();
  return {
      "Cells",
      {computed<std::int64_t>("Int64", "connectivity", count, [](std::size_t i) { return i; }),
       computed<std::int64_t>("Int64", "offsets", count, [](std::size_t i) { return i + 1; }),
       computed<std::uint8_t>("UInt8", "types", count, [](std::size_t) { return vtk_vertex; })}};
}

std::vector<Part> parts_of(const NodeSet& nodes) {
  std::vector<Part> parts{{"PointData",
                           {stored("Int64", "id", nodes.ids), stored("Int32", "tag", nodes.tags),
                            stored("Float64", "spacing", nodes.spacing)}}};
  if (nodes.triangle_count() > 0) {
    parts.push_back({"CellData",
                     {computed<float>("Float32", "quality", nodes.triangle_count(),
                                      [&nodes](std::size_t i) { return quality(nodes, i); })}});
  }
  parts.push_back({"Points", {points(nodes)}});
  parts.push_back(nodes.triangle_count() > 0 ? triangle_cells(nodes) : vertex_cells(nodes));
  return parts;
}

void declare(const std::vector<Part>& parts, Sink& sink) {
  std::uint64_t offset = 0;
  for (const Part& part : parts) {
    sink.text("      <" + part.name + (part.name == "PointData" ? " Scalars=\"spacing\"" : "") +
              ">\n");
    for (const Array& array : part.arrays) {
      sink.text("        <DataArray type=\"" + array.type + "\" Name=\"" + array.name + "\"");
      if (array.components > 1) {
        sink.text(" NumberOfComponents=\"" + std::to_string(array.components) + "\"");
      }
      sink.text(" format=\"appended\" offset=\"" + std::to_string(offset) + "\"/>\n");
      offset += sizeof array.bytes + array.bytes;
    }
    sink.text("      </" + part.name + ">\n");
  }
}

void append(const std::vector<Part>& parts, Sink& sink) {
  for (const Part& part : parts) {
    for (const Array& array : part.arrays) {
      sink.bytes(&array.bytes, sizeof array.bytes);
      array.write(sink);
    }
  }
}

}  // namespace

void write_vtu(const NodeSet& nodes, const PictureStyle& /*style*/, Sink& sink) {
  const std::vector<Part> parts = parts_of(nodes);
  const std::size_t cells = nodes.triangle_count() > 0 ? nodes.triangle_count() : nodes.size();
  const std::string order =
      std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
  sink.text(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"" +
      order + "\" header_type=\"UInt64\">\n  <UnstructuredGrid>\n    <Piece NumberOfPoints=\"" +
      std::to_string(nodes.size()) + "\" NumberOfCells=\"" + std::to_string(cells) + "\">\n");
  declare(parts, sink);
  sink.text("    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_");
  append(parts, sink);
  sink.text("\n  </AppendedData>\n</VTKFile>\n");
}

}  // namespace pnpbs::io
