// SPDX-License-Identifier: BSD-3-Clause
// OBJ reader (Wavefront, "Advanced Visualizer Manual", 1995, appendix B1). It reads vertices and
// faces, and the object (o), group (g) and material (usemtl) that name faces. Other statements are
// skipped.
#include <optional>

#include "formats/polygons.hpp"
#include "formats/surface_formats.hpp"
#include "formats/text_fields.hpp"

namespace pnpbs {

namespace {

class ObjParser {
 public:
  ObjParser(std::string_view text, const std::string& name)
      : fields_(text, name, Comments::whole_lines) {}

  SurfaceTriangles parse() {
    while (fields_.next_line()) read_line(*fields_.next());
    surface_.tag_names = tags_.take_names();
    return std::move(surface_);
  }

 private:
  void read_line(std::string_view keyword) {
    if (keyword == "v") {
      read_vertex();
    } else if (keyword == "f") {
      read_face();
    } else if (keyword == "o") {
      rename(object_);
    } else if (keyword == "g") {
      rename(group_);
    } else if (keyword == "usemtl") {
      rename(material_);
    }
  }

  std::int64_t vertices() const { return static_cast<std::int64_t>(surface_.vertices.size()); }

  void read_vertex() {
    if (vertices() == kMaxVertices) fields_.fail(kTooManyVertices);
    const double x = fields_.coordinate("x"), y = fields_.coordinate("y");
    surface_.vertices.push_back({x, y, fields_.coordinate("z")});
  }

  void rename(std::string& part) {
    part = fields_.rest_of_line();
    tag_ = 0;
  }

  // Returns the tag of the current combination of object, group and material.
  std::int32_t tag() {
    if (tag_ != 0) return tag_;
    std::string name;
    for (const std::string* part : {&object_, &group_, &material_}) {
      if (part->empty()) continue;
      if (!name.empty()) name += '/';
      name += *part;
    }
    return tag_ = tags_.tag_of(name);
  }

  void read_face() {
    corners_.clear();
    is_joined_ = false;
    while (const auto field = next_in_statement()) corners_.push_back(corner(*field));
    if (const auto problem = add_polygon(surface_, corners_, tag()); !problem.empty())
      fields_.fail(problem);
  }

  // Returns the next field of the statement. A backslash at the end of a line continues it.
  std::optional<std::string_view> next_in_statement() {
    for (;;) {
      auto field = fields_.next();
      if (!field) {
        if (!is_joined_ || !fields_.next_line()) return std::nullopt;
        is_joined_ = false;
        continue;
      }
      if (field->front() == '#') return std::nullopt;
      is_joined_ = field->ends_with('\\');
      if (is_joined_) field->remove_suffix(1);
      if (!field->empty()) return field;
    }
  }

  // Returns the vertex of a corner: "vertex", "vertex/texture", "vertex//normal" or
  // "vertex/texture/normal". Vertices count from 1, or from -1 backwards from the last one read.
  std::int32_t corner(std::string_view field) const {
    const std::int64_t number =
        fields_.integer_in(field.substr(0, field.find('/')), "a vertex number");
    const std::int64_t count = vertices();
    if (number == 0 || number > count || number < -count) {
      fields_.fail("there is no vertex " + std::to_string(number) + " among the " +
                   std::to_string(count) + " so far, which are counted from 1 or back from -1");
    }
    return static_cast<std::int32_t>(number > 0 ? number - 1 : count + number);
  }

  TextFields fields_;
  SurfaceTriangles surface_;
  TagNames tags_;
  std::string object_, group_, material_;
  std::int32_t tag_ = 0;  // tag of the next faces; 0: not determined yet
  std::vector<std::int32_t> corners_;
  bool is_joined_ = false;  // this line continues in the next one
};

}  // namespace

SurfaceTriangles parse_obj(std::string_view text, const std::string& name) {
  expect_text(text, name, "OBJ");
  return ObjParser(text, name).parse();
}

}  // namespace pnpbs
