// SPDX-License-Identifier: BSD-3-Clause
// Values at points as a file holds them: a mesh (.vtu, .msh) or scattered points (.csv, and files
// of meshes without elements).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "spacing/given_field.hpp"

namespace pnpbs {

struct FileField {
  std::string field;  // what the file calls it
  std::vector<Point<3>> points;
  std::vector<double> values;            // NaN where there is none
  std::vector<std::int32_t> triangles;   // corners; quadrangles are two
  std::vector<std::int32_t> tetrahedra;  // corners
  // Elements that fill space and are no tetrahedra; faces with more than four corners.
  std::int64_t other_solids = 0, other_faces = 0;
  bool has_z = true;
};

// Each takes the field that is wanted; "": the only one, or the one called "spacing". `name` stands
// for the file in messages. Throws Error(ErrorKind::file).
FileField parse_vtu_field(std::string_view bytes, const std::string& name,
                          const std::string& wanted);
FileField parse_msh_field(std::string_view bytes, const std::string& name,
                          const std::string& wanted);
FileField parse_csv_field(std::string_view text, const std::string& name,
                          const std::string& wanted);

// What a file calls its fields.
struct FieldName {
  std::string name;
  std::int64_t components = 1;
  bool may_be_meant = true;  // by those who do not say which
};
// The place of the wanted one among them. Throws Error(ErrorKind::file) with those there are.
std::size_t chosen_field(const std::vector<FieldName>& fields, const std::string& wanted,
                         const std::string& file);

// As a spacing is given there, GivenField<2>, GivenField<3> or SphereField; in the plane without z.
template <class Field>
Field given_field(const FileField& file, const std::string& name);

// By the ending of the file's name, in capitals or not. Throws Error(ErrorKind::file).
template <class Field>
Field read_field(const std::string& path, const std::string& wanted);

}  // namespace pnpbs
