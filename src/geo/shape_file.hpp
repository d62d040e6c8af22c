// SPDX-License-Identifier: BSD-3-Clause
// One layer of a file, as GDAL reads it: outlines of polygons, lines and points, in the file's own
// coordinates.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "geo/note.hpp"
#include "geo/reference_system.hpp"

namespace pnpbs::geo {

enum class PathKind { outline, hole, line };

struct Path {
  PathKind kind;
  std::int64_t feature;  // its number in the file
  std::int32_t tag;
  std::vector<Point<2>> points;  // of outlines and holes the first may be repeated at the end
};

struct Spot {
  std::int64_t feature;
  std::int32_t tag;
  Point<2> point;
};

struct LayerShapes {
  std::string name;  // of file and layer, for messages
  std::vector<Path> paths;
  std::vector<Spot> spots;
  std::map<std::int32_t, std::string> tag_names;
  ReferenceSystem system;  // none if the file names none
  std::vector<Note> notes;
};

// An empty layer name is for files that have only one. Tags are the values of the field: numbers as
// they are, texts numbered from 1 on and named; 1 without a field. Throws Error.
LayerShapes read_layer(const std::string& path, const std::string& layer,
                       const std::string& tag_field);

}  // namespace pnpbs::geo
