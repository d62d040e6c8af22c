// SPDX-License-Identifier: BSD-3-Clause
// Sections common to the files of Triangle (.poly in the plane) and TetGen (.poly and .smesh in
// space): vertices, holes, regions.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/warning.hpp"
#include "formats/text_fields.hpp"

namespace pnpbs {

// A section of vertices.
template <int Dim>
struct VertexSection {
  std::int64_t first_number = 0;    // number of the first vertex in the file, 0 or 1
  std::vector<double> coordinates;  // [vertices][Dim]
  std::vector<std::int32_t> tags;

  std::int64_t count() const { return static_cast<std::int64_t>(tags.size()); }
};

// The contents of a .node file. The text must outlive the fields that refer to it.
struct NodeFile {
  std::string text;
  std::string name;
};

// Goes to the first line of a section; throws if the file ends.
void begin_section(TextFields& fields, const std::string& what);
// Returns the number of items at the current field. Throws if it is negative or missing.
std::int64_t read_count(TextFields& fields, const std::string& what);

// Returns a number that may be missing at the end of its line. Throws if it is not in 0 to `max`.
std::int64_t read_optional(TextFields& fields, const std::string& what, std::int64_t max,
                           std::int64_t if_missing = 0);

// Calls read() for each of `count` lines. Memory grows only with lines that exist. Further fields
// of a line are ignored, as Triangle does.
void read_lines(TextFields& fields, std::int64_t count, const std::string& what,
                const std::function<void()>& read);

// Reads the vertices, from the .node file if the section is empty. Throws if it is empty and
// `node_file` is null.
template <int Dim>
VertexSection<Dim> read_vertices(TextFields& fields, const std::function<NodeFile()>& node_file);

// Reads a vertex number of the file and returns the index of the vertex, from 0.
template <int Dim>
std::int64_t read_vertex(TextFields& fields, const VertexSection<Dim>& vertices);

// Reads the holes: [holes][Dim].
template <int Dim>
std::vector<double> read_holes(TextFields& fields);

// The regions with a tag.
template <int Dim>
struct RegionSection {
  std::vector<double> points;        // [regions][Dim]
  std::vector<std::int32_t> tags;    // tag of each region; not 0
  std::vector<std::string> names;    // name of each region, for messages
  std::vector<std::string> skipped;  // attributes that are no tags, with the names of the regions
};

// Reads the regions, which may be missing, and requires the end of the file.
template <int Dim>
RegionSection<Dim> read_regions(TextFields& fields);

// Returns a warning about skipped regions, or nothing if none exist.
std::optional<Warning> warning_of_skipped(const std::vector<std::string>& skipped,
                                          const std::string& file);

}  // namespace pnpbs
