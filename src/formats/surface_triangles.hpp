// SPDX-License-Identifier: BSD-3-Clause
// Triangulated surfaces in files: STL (text, binary), OFF, OBJ, PLY (text, binary), TetGen's .poly
// and .smesh. The readers repair nothing. They only divide polygons into triangles and, in STL
// files, merge equal corners.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/types.hpp"
#include "base/warning.hpp"

namespace pnpbs {

// A point that marks a region of the domain.
struct SurfaceRegion {
  Point<3> point;
  std::string name;  // name in messages
  std::int32_t tag;
};

// The contents of a surface file.
struct SurfaceTriangles {
  std::vector<Point<3>> vertices;
  // Indices of vertices, from 0. A triangle may have equal corners.
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> tags;  // tag of each triangle; 1 if the file has none
  // Tags with names in the file: solids of an STL, groups, objects and materials of an OBJ.
  std::vector<std::pair<std::int32_t, std::string>> tag_names;
  // True for TetGen's files: the facets divide the enclosed space into regions, which all belong to
  // the domain except those with a hole point.
  bool divides = false;
  // From TetGen's files: a point in each hole, and in each region with a tag.
  std::vector<Point<3>> holes;
  std::vector<SurfaceRegion> regions;
  std::vector<Warning> warnings;
};

enum class SurfaceFormat { stl, off, obj, ply, poly, smesh };

// Returns the format by the extension, in upper or lower case. Throws Error(ErrorKind::file) for
// other extensions.
SurfaceFormat surface_format(const std::string& path);

// Reads a surface file. A .poly or .smesh without vertices ("0 3 0 0") takes them from the .node
// file of the same name. Throws Error(ErrorKind::file, "path:line: ..."), or "path: at byte 84:
// ..." for binary files.
SurfaceTriangles read_surface(const std::string& path);

}  // namespace pnpbs
