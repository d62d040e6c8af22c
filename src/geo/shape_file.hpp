// SPDX-License-Identifier: BSD-3-Clause
// One layer of a vector file, read by GDAL: outlines of polygons, lines and points, in the
// coordinates of the file.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/types.hpp"
#include "geo/reference_system.hpp"
#include "pnpbs/pnpbs_geo.h"

namespace pnpbs::geo {

// Codes of the notes on how a file was interpreted.
enum class NoteCode : std::int32_t {
  no_geometry = PNPBS_GEO_NOTE_NO_GEOMETRY,
  heights_left_out = PNPBS_GEO_NOTE_HEIGHTS_LEFT_OUT,
  nearly_touching = PNPBS_GEO_NOTE_NEARLY_TOUCHING,
  no_reference_system = PNPBS_GEO_NOTE_NO_REFERENCE_SYSTEM,
  degrees_in_plane = PNPBS_GEO_NOTE_DEGREES_IN_PLANE,
  scale = PNPBS_GEO_NOTE_SCALE,
  segments_retagged = PNPBS_GEO_NOTE_SEGMENTS_RETAGGED,
  lines_along_boundary = PNPBS_GEO_NOTE_LINES_ALONG_BOUNDARY,
  shared_segments_left_out = PNPBS_GEO_NOTE_SHARED_SEGMENTS_LEFT_OUT,
  whole_sphere = PNPBS_GEO_NOTE_WHOLE_SPHERE,
  lines_left_out = PNPBS_GEO_NOTE_LINES_LEFT_OUT,
  segments_left_out = PNPBS_GEO_NOTE_SEGMENTS_LEFT_OUT
};

// A note on how a file was interpreted.
struct Note {
  Note(NoteCode of, MessageText words, std::int64_t how_many = 0)
      : code(of), text(as_worded(std::move(words)).text()), count(how_many) {}

  NoteCode code;
  std::string text;
  std::int64_t count;  // number of the features, segments or lines concerned; 0: not a count
};

// Returns a note. Throws Error if none exists of this index.
inline const Note& note_at(const std::vector<Note>& notes, std::int32_t index) {
  if (index < 0 || index >= std::ssize(notes))
    throw Error(ErrorKind::argument, "argument index = " + std::to_string(index) + ": there are " +
                                         std::to_string(notes.size()) + " notes");
  return notes[static_cast<std::size_t>(index)];
}

enum class PathKind { outline, hole, line };

// An outline, hole or line of a feature.
struct Path {
  PathKind kind;
  std::int64_t feature;  // number of the feature in the file
  std::int32_t tag;
  std::vector<Point<2>> points;  // outlines and holes may repeat the first point at the end
};

// A point feature.
struct Spot {
  std::int64_t feature;
  std::int32_t tag;
  Point<2> point;
};

// The contents of a layer.
struct LayerShapes {
  std::string name;  // name of file and layer, for messages
  std::vector<Path> paths;
  std::vector<Spot> spots;
  std::map<std::int32_t, std::string> tag_names;
  // Region of the elements in the polygons of each feature, 0 for none, and names of regions. Empty
  // without a region field.
  std::map<std::int64_t, std::int32_t> regions;
  std::map<std::int32_t, std::string> region_names;
  ReferenceSystem system;  // empty if the file names none
  std::vector<Note> notes;
};

// Reads a layer; its name may be empty if the file has only one. Tags are the values of
// `tag_field`: integers as they are, texts numbered from 1 and named. Without a field they are 1.
// Regions are the values that polygons have in `region_field`: integers as they are, others
// numbered from 1 in sorted order and named. Throws Error.
LayerShapes read_layer(const std::string& path, const std::string& layer,
                       const std::string& tag_field, const std::string& region_field);

}  // namespace pnpbs::geo
