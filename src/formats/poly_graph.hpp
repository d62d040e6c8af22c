// SPDX-License-Identifier: BSD-3-Clause
// Triangle's .poly format (https://www.cs.cmu.edu/~quake/triangle.poly.html): vertices, segments,
// holes, regions.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "formats/poly_sections.hpp"

namespace pnpbs {

struct PolyGraph {
  std::string name;  // of the file
  VertexSection<2> vertices;
  std::vector<std::int64_t> segment_ends;  // two of each: vertices, from 0
  std::vector<std::int32_t> segment_tags;  // 1 where the file has none
  std::vector<double> holes;               // two coordinates of each
  RegionSection<2> regions;
};

// If the file holds no vertices ("0 2 0 0"), they are read from the .node file beside it. Throws
// Error(ErrorKind::file, "file:line: ...").
PolyGraph read_poly(const std::string& path);

// The same from text. `name` stands for the file in messages.
PolyGraph parse_poly(std::string_view text, const std::string& name);

}  // namespace pnpbs
