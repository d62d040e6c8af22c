// SPDX-License-Identifier: BSD-3-Clause
// One layer of a file, as GDAL reads it: outlines of polygons, lines and points, in the file's own
// coordinates.
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

// Notes on how a file was interpreted, as data.
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

struct Note {
  Note(NoteCode of, MessageText words, std::int64_t how_many = 0)
      : code(of), text(as_worded(std::move(words)).text()), count(how_many) {}

  NoteCode code;
  std::string text;
  std::int64_t count;  // of the features, segments or lines that it is about; 0: none
};

// Throws Error where there is no such note.
inline const Note& note_at(const std::vector<Note>& notes, std::int32_t index) {
  if (index < 0 || index >= std::ssize(notes))
    throw Error(ErrorKind::argument, "argument index = " + std::to_string(index) + ": there are " +
                                         std::to_string(notes.size()) + " notes");
  return notes[static_cast<std::size_t>(index)];
}

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
