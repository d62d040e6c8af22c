// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/files/field_file.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/extension.hpp"
#include "base/point_text.hpp"
#include "formats/text_fields.hpp"

namespace pnpbs {

namespace {

FileField parse(const std::string& path, const std::string& wanted) {
  const std::string extension = extension_of(path);
  const auto parse = extension == "vtu"   ? parse_vtu_field
                     : extension == "msh" ? parse_msh_field
                     : extension == "csv" ? parse_csv_field
                                          : nullptr;
  if (!parse)
    throw Error(ErrorKind::file, path +
                                     ": expected the name of a file that ends in .vtu, .msh or "
                                     ".csv, for a spacing from its values");
  return parse(read_whole_file(path), path, wanted);
}

std::string listed(const std::vector<FieldName>& fields) {
  if (fields.empty()) return "it has none";
  std::vector<std::string> names;
  for (const FieldName& field : fields)
    names.push_back(
        "'" + field.name + "'" +
        (field.components == 1 ? "" : " (" + std::to_string(field.components) + " components)"));
  return "it has " + list_text(names, 20);
}

template <class Field>
void take_elements(const std::vector<std::int32_t>& corners, Field& field) {
  constexpr std::size_t kCorners = Field::corners;
  field.elements.resize(corners.size() / kCorners);
  for (std::size_t e = 0; e < field.elements.size(); ++e)
    std::copy_n(corners.begin() + static_cast<std::ptrdiff_t>(e * kCorners), kCorners,
                field.elements[e].begin());
}

}  // namespace

std::size_t chosen_field(const std::vector<FieldName>& fields, const std::string& wanted,
                         const std::string& file) {
  const auto fail = [&](const std::string& why) {
    throw Error(ErrorKind::file, file + ": " + why + "; of values at points " + listed(fields));
  };
  std::size_t found = fields.size(), meant = 0;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (wanted.empty() && fields[i].components == 1 && fields[i].default_candidate) {
      ++meant;
      found = i;
    }
    if (fields[i].name == (wanted.empty() ? "spacing" : wanted)) {
      if (!wanted.empty() && fields[i].components != 1)
        fail("field '" + wanted + "' has " + std::to_string(fields[i].components) +
             " components, expected one");
      if (fields[i].components == 1) return i;
    }
  }
  if (!wanted.empty()) fail("there is no field '" + wanted + "'");
  if (meant == 0) fail("expected a field with one number at each point");
  if (meant > 1) fail("expected the name of the field that is the spacing");
  return found;
}

template <class Field>
Field given_field(const FileField& file, const std::string& name) {
  constexpr bool kTriangles = Field::corners == 3;
  if (Field::dim == 3 && !file.has_z)
    throw Error(ErrorKind::file, name + ": there is no column z, expected one " +
                                     (kTriangles ? "on a sphere" : "in space"));
  Field field;
  field.points_name = name + ": points";
  field.values_name = name + ": " + file.field;
  field.elements_name = name + (kTriangles ? ": triangles" : ": tetrahedra");
  field.points.resize(file.points.size());
  for (std::size_t i = 0; i < file.points.size(); ++i)
    std::copy_n(file.points[i].begin(), Field::dim, field.points[i].begin());
  field.values = file.values;
  field.fault = ErrorKind::file;
  field.only_used = true;
  const std::int64_t others = kTriangles ? file.other_faces : file.other_solids;
  if (others > 0)
    throw Error(ErrorKind::file,
                name + ": " + std::to_string(others) + " elements are " +
                    (kTriangles ? "neither triangles nor quadrangles" : "no tetrahedra") +
                    ", expected a mesh of " +
                    (kTriangles ? "these" : "these (ParaView's filter Tetrahedralize makes one)"));
  take_elements(kTriangles ? file.triangles : file.tetrahedra, field);
  return field;
}

template <class Field>
Field read_field(const std::string& path, const std::string& wanted) {
  return given_field<Field>(parse(path, wanted), path);
}

template GivenField<2> given_field(const FileField&, const std::string&);
template GivenField<3> given_field(const FileField&, const std::string&);
template SphereField given_field(const FileField&, const std::string&);
template GivenField<2> read_field(const std::string&, const std::string&);
template GivenField<3> read_field(const std::string&, const std::string&);
template SphereField read_field(const std::string&, const std::string&);

}  // namespace pnpbs
