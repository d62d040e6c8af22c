// SPDX-License-Identifier: BSD-3-Clause
// The sections that the files of Triangle (.poly in the plane) and TetGen (.poly and .smesh in
// space) have in common: vertices, holes, regions.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/warning.hpp"
#include "formats/text_fields.hpp"

namespace pnpbs {

template <int Dim>
struct VertexSection {
  std::int64_t first_number = 0;    // 0 or 1
  std::vector<double> coordinates;  // Dim of each vertex
  std::vector<std::int32_t> tags;

  std::int64_t count() const { return static_cast<std::int64_t>(tags.size()); }
};

// A .node file. Its text must outlive the fields read from it.
struct NodeFile {
  std::string text;
  std::string name;
};

// A section's first line, and the count that it begins with.
void begin_section(TextFields& fields, const std::string& what);
std::int64_t read_count(TextFields& fields, const std::string& what);

// A count that may be left out at the end of its line.
std::int64_t read_optional(TextFields& fields, const std::string& what, std::int64_t max,
                           std::int64_t if_missing = 0);

// A section's lines. Nothing is allocated for lines that do not come. Like Triangle, takes no
// notice of further fields at the end of a line.
void read_lines(TextFields& fields, std::int64_t count, const std::string& what,
                const std::function<void()>& read);

// The vertices here or, where there are none, in the .node file; without `node_file` an error.
template <int Dim>
VertexSection<Dim> read_vertices(TextFields& fields, const std::function<NodeFile()>& node_file);

// A vertex by its number in the file; from 0 here.
template <int Dim>
std::int64_t read_vertex(TextFields& fields, const VertexSection<Dim>& vertices);

// Dim coordinates of each hole.
template <int Dim>
std::vector<double> read_holes(TextFields& fields);

// Regions with a tag.
template <int Dim>
struct RegionSection {
  std::vector<double> points;        // Dim coordinates of each
  std::vector<std::int32_t> tags;    // of each; nonzero
  std::vector<std::string> names;    // of each, for messages
  std::vector<std::string> skipped;  // names and attributes of those that have another attribute
};

// Regions, which may be missing, and the end of the file.
template <int Dim>
RegionSection<Dim> read_regions(TextFields& fields);

// Nothing if none was.
std::optional<Warning> warning_of_skipped(const std::vector<std::string>& skipped,
                                          const std::string& file);

}  // namespace pnpbs
