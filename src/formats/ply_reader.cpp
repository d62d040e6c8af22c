// SPDX-License-Identifier: BSD-3-Clause
// PLY reader. It reads x, y and z of vertices and the vertex lists of faces; other elements and
// properties are skipped.
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/byte_fields.hpp"
#include "formats/poly_sections.hpp"
#include "formats/polygons.hpp"
#include "formats/surface_formats.hpp"
#include "formats/text_fields.hpp"

namespace pnpbs {
namespace {

// Types of properties in a PLY header (G. Turk, "The PLY Polygon File Format", 1994), which also
// have the newer names with sizes.
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

bool is_integer(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

struct PlyProperty {
  std::string name;
  PlyType type;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  // type of the length of a list
};

struct PlyElement {
  std::string name;
  std::int64_t count;
  std::vector<PlyProperty> properties;

  // Returns the index of the property, or the number of properties if none exists of this name.
  std::size_t place_of(std::string_view property) const;
};

enum class PlyEncoding { text, little_endian, big_endian };

struct PlyHeader {
  PlyEncoding encoding;
  std::vector<PlyElement> elements;
};

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
    if (!is_integer(property.count_type))
      fields.fail("the length of a list has a real type, expected an integer type");
  }
  property.type = read_type(fields);
  property.name = fields.required("the name of a property");
  return property;
}

std::size_t PlyElement::place_of(std::string_view property) const {
  const auto found =
      std::find_if(properties.begin(), properties.end(),
                   [property](const PlyProperty& each) { return each.name == property; });
  return static_cast<std::size_t>(found - properties.begin());
}

// Parses the header. The fields are left at the end of its last line.
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

// Data of a PLY file as text.
class TextSource {
 public:
  explicit TextSource(TextFields fields) : fields_(std::move(fields)) {}

  bool next_row() { return fields_.next_line(); }
  double coordinate(PlyType, std::string_view what) { return fields_.coordinate(what); }
  std::int64_t integer(PlyType, std::string_view what) { return fields_.integer(what); }
  void skip(PlyType, std::string_view what) { fields_.required(what); }
  bool at_end() { return !fields_.next_line(); }
  [[noreturn]] void fail(const std::string& message) const { fields_.fail(message); }

 private:
  TextFields fields_;
};

// Data of a PLY file in binary form.
class BinarySource {
 public:
  explicit BinarySource(const ByteFields& fields) : fields_(fields) {}

  bool next_row() const { return fields_.remaining() > 0; }
  bool at_end() const { return fields_.remaining() == 0; }
  [[noreturn]] void fail(const std::string& message) const { fields_.fail(message); }

  double coordinate(PlyType type, std::string_view what) {
    if (type == PlyType::float32) return fields_.coordinate<float>(what);
    if (type == PlyType::float64) return fields_.coordinate<double>(what);
    return static_cast<double>(integer(type, what));
  }

  std::int64_t integer(PlyType type, std::string_view what) {
    switch (type) {
      case PlyType::int8:
        return fields_.next<std::int8_t>(what);
      case PlyType::uint8:
        return fields_.next<std::uint8_t>(what);
      case PlyType::int16:
        return fields_.next<std::int16_t>(what);
      case PlyType::uint16:
        return fields_.next<std::uint16_t>(what);
      case PlyType::int32:
        return fields_.next<std::int32_t>(what);
      case PlyType::uint32:
        return fields_.next<std::uint32_t>(what);
      case PlyType::float32:
      case PlyType::float64:
        break;
    }
    fail("found no integer type, expected one for " + std::string(what));
  }

  void skip(PlyType type, std::string_view what) {
    if (type == PlyType::float32) {
      fields_.next<float>(what);
    } else if (type == PlyType::float64) {
      fields_.next<double>(what);
    } else {
      integer(type, what);
    }
  }

 private:
  ByteFields fields_;
};

// Parser of the data that follow the header.
template <class Source>
class Body {
 public:
  explicit Body(Source source) : source_(std::move(source)) {}

  SurfaceTriangles parse(const PlyHeader& header) {
    std::vector<std::pair<const PlyElement*, Source>> early_faces;  // before the vertices
    for (const PlyElement& element : header.elements) {
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face" && !surface_.vertices.empty()) {
        read_faces(element);
      } else {
        if (element.name == "face") early_faces.emplace_back(&element, source_);
        skip_rows(element);
      }
    }
    if (!source_.at_end()) source_.fail("found more than the header declares");
    for (auto& [element, source] : early_faces) {
      source_ = std::move(source);
      read_faces(*element);
    }
    return std::move(surface_);
  }

 private:
  // Calls read(property, index) for each property of each row, and end_row() after each row.
  template <class Read, class EndRow>
  void read_rows(const PlyElement& element, const Read& read, const EndRow& end_row) {
    for (std::int64_t i = 0; i < element.count; ++i) {
      if (!source_.next_row())
        source_.fail("the file ends after " + part_of(i, element.count, element.name));
      for (std::size_t k = 0; k < element.properties.size(); ++k) read(element.properties[k], k);
      end_row();
    }
  }
  template <class Read>
  void read_rows(const PlyElement& element, const Read& read) {
    read_rows(element, read, [] {});
  }

  void skip_rows(const PlyElement& element) {
    if (element.properties.empty()) return;
    read_rows(element, [this](const PlyProperty& property, std::size_t) { skip(property); });
  }

  void read_vertices(const PlyElement& element) {
    if (element.count > kMaxVertices) source_.fail(kTooManyVertices);
    constexpr std::array kAxes{"x", "y", "z"};
    std::vector<std::size_t> axis_of(element.properties.size(), kAxes.size());
    for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
      const std::size_t place = element.place_of(kAxes[axis]);
      if (place == axis_of.size() || element.properties[place].is_list)
        source_.fail(std::string("the header has no property ") + kAxes[axis] + " of vertices");
      axis_of[place] = axis;
    }
    Point<3> vertex;
    read_rows(
        element,
        [&](const PlyProperty& property, std::size_t place) {
          const std::size_t axis = axis_of[place];
          if (axis == kAxes.size()) return skip(property);
          vertex[axis] = source_.coordinate(property.type, kAxes[axis]);
        },
        [&] { surface_.vertices.push_back(vertex); });
  }

  void read_faces(const PlyElement& element) {
    std::size_t list = element.place_of("vertex_indices");
    if (list == element.properties.size()) list = element.place_of("vertex_index");
    if (list == element.properties.size() || !element.properties[list].is_list ||
        !is_integer(element.properties[list].type)) {
      source_.fail("the header has no list of integers 'vertex_indices' of faces");
    }
    if (surface_.vertices.empty()) source_.fail("found no vertices");
    read_rows(
        element,
        [&](const PlyProperty& property, std::size_t place) {
          if (place != list) return skip(property);
          read_corners(property);
        },
        [this] {
          if (const auto problem = add_polygon(surface_, corners_, 1); !problem.empty())
            source_.fail(problem);
        });
  }

  void read_corners(const PlyProperty& property) {
    const auto vertices = static_cast<std::int64_t>(surface_.vertices.size());
    corners_.clear();
    for (std::int64_t left = read_length(property); left > 0; --left) {
      const std::int64_t number = source_.integer(property.type, "a vertex number");
      if (number < 0 || number >= vertices) source_.fail(no_such_vertex(number, vertices));
      corners_.push_back(static_cast<std::int32_t>(number));
    }
  }

  void skip(const PlyProperty& property) {
    const std::int64_t count = property.is_list ? read_length(property) : 1;
    for (std::int64_t left = count; left > 0; --left) source_.skip(property.type, property.name);
  }

  std::int64_t read_length(const PlyProperty& property) {
    const std::int64_t length = source_.integer(property.count_type, "the length of a list");
    if (length < 0) source_.fail("the length of " + property.name + " is negative");
    return length;
  }

  Source source_;
  SurfaceTriangles surface_;
  std::vector<std::int32_t> corners_;
};

// Returns the size of the header of a binary file, whose last line was read. If its lines end in CR
// alone, an LF behind the last one belongs to the data.
std::size_t header_size(std::string_view bytes, const TextFields& fields) {
  const std::size_t size = bytes.size() - fields.rest().size();
  const bool ends_in_cr = !bytes.substr(bytes.find_first_of("\r\n")).starts_with("\r\n");
  return size - (ends_in_cr && bytes.substr(0, size).ends_with("\r\n") ? 1 : 0);
}

}  // namespace

SurfaceTriangles parse_ply(std::string_view bytes, const std::string& name) {
  TextFields fields(bytes, name, Comments::whole_lines);
  const PlyHeader header = parse_ply_header(fields);
  if (header.encoding == PlyEncoding::text) {
    expect_text(bytes, name, "PLY");
    return Body<TextSource>(TextSource(std::move(fields))).parse(header);
  }
  const std::endian order =
      header.encoding == PlyEncoding::little_endian ? std::endian::little : std::endian::big;
  return Body<BinarySource>(BinarySource({bytes, header_size(bytes, fields), order, name}))
      .parse(header);
}

}  // namespace pnpbs
