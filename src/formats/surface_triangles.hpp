// SPDX-License-Identifier: BSD-3-Clause
// Triangulated surfaces as files hold them: STL (text, binary), OFF, OBJ, PLY (text, binary),
// TetGen's .poly and .smesh. Nothing is mended here but what the format itself asks for: polygons
// become triangles, and equal corners of an STL's triangles one vertex.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/types.hpp"
#include "base/warning.hpp"

namespace pnpbs {

struct SurfaceRegion {
  Point<3> point;
  std::string name;  // for messages
  std::int32_t tag;
};

struct SurfaceTriangles {
  std::vector<Point<3>> vertices;
  // Vertices, from 0. Two may be the same, or all.
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> tags;  // of triangles; 1 where the file has none
  // Where the file names what it tags: solids of an STL, groups, objects and materials of an OBJ.
  std::vector<std::pair<std::int32_t, std::string>> tag_names;
  // True of TetGen's files: their facets divide what they enclose into regions, all of them part of
  // the domain but those with a hole point.
  bool divides = false;
  // From TetGen's files: a point in each cavity, and in regions with a tag.
  std::vector<Point<3>> holes;
  std::vector<SurfaceRegion> regions;
  std::vector<Warning> warnings;
};

enum class SurfaceFormat { stl, off, obj, ply, poly, smesh };

// By the ending of the file's name, in capitals or not. Throws Error(ErrorKind::file) for others.
SurfaceFormat surface_format(const std::string& path);

// Throws Error(ErrorKind::file, "path:line: ...") or, from binary files, "path: at byte 84: ...".
// A .poly or .smesh that holds no vertices ("0 3 0 0") has them in the .node file beside it.
SurfaceTriangles read_surface(const std::string& path);

}  // namespace pnpbs
