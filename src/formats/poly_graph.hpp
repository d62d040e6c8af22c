// SPDX-License-Identifier: BSD-3-Clause
// Plane straight-line graphs in Triangle's .poly format
// (https://www.cs.cmu.edu/~quake/triangle.poly.html): vertices, segments, holes, regions.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "formats/poly_sections.hpp"

namespace pnpbs {

// The contents of a .poly file of the plane.
struct PolyGraph {
  std::string name;  // name of the file
  VertexSection<2> vertices;
  std::vector<std::int64_t> segment_ends;  // [segments][2], indices of vertices from 0
  std::vector<std::int32_t> segment_tags;  // 1 if the file has no markers
  std::vector<double> holes;               // [holes][2], coordinates
  RegionSection<2> regions;
};

// Reads a .poly file. If it has no vertices ("0 2 0 0"), reads the .node file of the same name.
// Throws Error(ErrorKind::file, "file:line: ...").
PolyGraph read_poly(const std::string& path);

// Parses the text of a .poly file, which must have its vertices. `name` stands for the file in
// messages.
PolyGraph parse_poly(std::string_view text, const std::string& name);

}  // namespace pnpbs
