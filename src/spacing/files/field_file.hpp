// SPDX-License-Identifier: BSD-3-Clause
// Values at points as read from a file: a mesh (.vtu, .msh) or scattered points (.csv, and mesh
// files without elements).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "spacing/given_field.hpp"

namespace pnpbs {

// A field of a file with its points and elements.
struct FileField {
  std::string field;  // name in the file
  std::vector<Point<3>> points;
  std::vector<double> values;            // NaN: no value
  std::vector<std::int32_t> triangles;   // three corners each; a quadrangle is split into two
  std::vector<std::int32_t> tetrahedra;  // four corners each
  // Numbers of elements that cannot be used: solids other than tetrahedra, and faces with more than
  // four corners.
  std::int64_t other_solids = 0, other_faces = 0;
  // false if a table has no column z
  bool has_z = true;
};

// Parses a file and returns its field `wanted`; if that is empty, the only field, or the one called
// "spacing". `name` is the name of the file in messages. Throws Error(ErrorKind::file).
FileField parse_vtu_field(std::string_view bytes, const std::string& name,
                          const std::string& wanted);
FileField parse_msh_field(std::string_view bytes, const std::string& name,
                          const std::string& wanted);
FileField parse_csv_field(std::string_view text, const std::string& name,
                          const std::string& wanted);

// A field of a file that can be chosen.
struct FieldName {
  std::string name;
  std::int64_t components = 1;
  bool default_candidate = true;  // false: chosen only by name
};
// Returns the index of the field `wanted`, which may be empty as above. Throws
// Error(ErrorKind::file), which lists the fields.
std::size_t chosen_field(const std::vector<FieldName>& fields, const std::string& wanted,
                         const std::string& file);

// Converts to GivenField<2>, GivenField<3> or SphereField, in the plane without z. `name` is the
// name of the file in messages. Throws Error(ErrorKind::file) if elements or coordinates do not
// fit.
template <class Field>
Field given_field(const FileField& file, const std::string& name);

// Reads a field from a file. The extension of its name, in upper or lower case, determines the
// format. Throws Error(ErrorKind::file).
template <class Field>
Field read_field(const std::string& path, const std::string& wanted);

}  // namespace pnpbs
