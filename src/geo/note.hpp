// SPDX-License-Identifier: BSD-3-Clause
// Notes on how a file was interpreted, as data.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "pnpbs/pnpbs_geo.h"

namespace pnpbs::geo {

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

}  // namespace pnpbs::geo
