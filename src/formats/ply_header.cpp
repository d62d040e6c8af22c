// SPDX-License-Identifier: BSD-3-Clause
#include "formats/ply_header.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "formats/poly_sections.hpp"

namespace pnpbs {

namespace {

constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes{
    {{"char", PlyType::int8},
     {"int8", PlyType::int8},
     {"uchar", PlyType::uint8},
     {"uint8", PlyType::uint8},
     {"short", PlyType::int16},
     {"int16", PlyType::int16},
     {"ushort", PlyType::uint16},
     {"uint16", PlyType::uint16},
     {"int", PlyType::int32},
     {"int32", PlyType::int32},
     {"uint", PlyType::uint32},
     {"uint32", PlyType::uint32},
     {"float", PlyType::float32},
     {"float32", PlyType::float32},
     {"double", PlyType::float64},
     {"float64", PlyType::float64}}};

PlyType read_type(TextFields& fields) {
  const std::string what = "a type such as 'float'";
  const std::string_view field = fields.required(what);
  const auto found = std::find_if(kTypes.begin(), kTypes.end(),
                                  [field](const auto& type) { return type.first == field; });
  if (found == kTypes.end()) fields.fail_found(field, what);
  return found->second;
}

PlyEncoding read_encoding(TextFields& fields) {
  const std::string what = "'ascii', 'binary_little_endian' or 'binary_big_endian'";
  const std::string_view field = fields.required(what);
  if (field == "ascii") return PlyEncoding::text;
  if (field == "binary_little_endian") return PlyEncoding::little_endian;
  if (field == "binary_big_endian") return PlyEncoding::big_endian;
  fields.fail_found(field, what);
}

PlyElement read_element(TextFields& fields) {
  PlyElement element;
  element.name = fields.required("the name of an element");
  element.count = read_count(fields, element.name);
  return element;
}

PlyProperty read_property(TextFields& fields) {
  PlyProperty property;
  TextFields ahead = fields;
  if (ahead.required("a type") == "list") {
    fields = ahead;
    property.is_list = true;
    property.count_type = read_type(fields);
    if (!is_integer(property.count_type)) fields.fail("a list is counted by an integer type");
  }
  property.type = read_type(fields);
  property.name = fields.required("the name of a property");
  return property;
}

}  // namespace

std::size_t PlyElement::place_of(std::string_view property) const {
  const auto found =
      std::find_if(properties.begin(), properties.end(),
                   [property](const PlyProperty& each) { return each.name == property; });
  return static_cast<std::size_t>(found - properties.begin());
}

PlyHeader parse_ply_header(TextFields& fields) {
  if (!fields.next_line()) fields.fail("the file ends, expected 'ply'");
  if (const auto field = fields.required("'ply'"); field != "ply")
    fields.fail_found(field, "'ply'");
  PlyHeader header{};
  bool has_format = false;
  for (;;) {
    const std::string what = "a line of the header, such as 'end_header'";
    if (!fields.next_line()) fields.fail("the file ends, expected " + what);
    const std::string_view keyword = fields.required(what);
    if (keyword == "format") {
      header.encoding = read_encoding(fields);
      has_format = true;
    } else if (keyword == "element") {
      header.elements.push_back(read_element(fields));
    } else if (keyword == "property") {
      if (header.elements.empty()) fields.fail("found a property before the first element");
      header.elements.back().properties.push_back(read_property(fields));
    } else if (keyword == "end_header") {
      if (!has_format) fields.fail("the header has no line 'format'");
      return header;
    } else if (keyword != "comment" && keyword != "obj_info") {
      fields.fail_found(keyword, what);
    }
  }
}

}  // namespace pnpbs
