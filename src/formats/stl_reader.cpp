// SPDX-License-Identifier: BSD-3-Clause
// STL reader (3D Systems, "StereoLithography Interface Specification", 1988). A text file has one
// or more solids with names. A binary file has a header of 80 bytes, the number of triangles, and
// 50 bytes for each.
#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/mixed_hash.hpp"
#include "base/small_letters.hpp"
#include "base/types.hpp"
#include "formats/byte_fields.hpp"
#include "formats/surface_formats.hpp"
#include "formats/text_fields.hpp"

namespace pnpbs {
namespace {

// A numbering of points in the order of first appearance. Points with equal coordinates are one
// vertex.
class VertexTable {
 public:
  std::int32_t index_of(Point<3> x);
  std::vector<Point<3>> take_points() { return std::move(points_); }

 private:
  std::size_t slot_of(const Point<3>& x) const;
  void grow();

  std::vector<Point<3>> points_;
  std::vector<std::int32_t>
      slots_;  // open addressing: indices of points or -1; at least half are -1
};

constexpr std::int32_t kFree = -1;

std::uint64_t hash_of(const Point<3>& x) {
  std::uint64_t hash = 0;
  for (const double coordinate : x) hash = mixed_with(hash, coordinate);
  return hash;
}

// Returns the slot of the point, or the free slot in which to store it.
std::size_t VertexTable::slot_of(const Point<3>& x) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash_of(x) & mask;
  while (slots_[slot] != kFree && points_[static_cast<std::size_t>(slots_[slot])] != x)
    slot = (slot + 1) & mask;
  return slot;
}

void VertexTable::grow() {
  slots_.assign(slots_.empty() ? 64 : 4 * slots_.size(), kFree);
  for (std::size_t i = 0; i < points_.size(); ++i)
    slots_[slot_of(points_[i])] = static_cast<std::int32_t>(i);
}

std::int32_t VertexTable::index_of(Point<3> x) {
  for (double& coordinate : x) coordinate += 0.0;  // turns -0 into 0
  if (2 * points_.size() >= slots_.size()) grow();
  std::int32_t& slot = slots_[slot_of(x)];
  if (slot == kFree) {
    slot = static_cast<std::int32_t>(points_.size());
    points_.push_back(x);
  }
  return slot;
}

constexpr std::size_t kHeader = 80;
constexpr std::size_t kBeforeTriangles = kHeader + 4;
constexpr std::size_t kTriangle = 50;
constexpr std::size_t kNormal = 12;

// Largest number of triangles whose corners all fit into the vertex numbers.
constexpr std::size_t kMaxTriangles = kMaxVertices / 3;
constexpr const char* kTooManyTriangles = "more than 715827882 triangles";

// Returns whether the field is the word, in upper or lower case.
bool is_word(std::string_view field, std::string_view word) {
  return std::ranges::equal(field, word, {}, [](char c) { return to_lower_case(c); });
}

class TextParser {
 public:
  TextParser(std::string_view text, const std::string& name)
      : fields_(text, name, Comments::whole_lines) {}

  SurfaceTriangles parse() {
    while (fields_.next_line()) {
      expect({"solid"});
      read_solid(std::string(fields_.rest_of_line()));
    }
    surface_.vertices = vertices_.take_points();
    surface_.tag_names = tags_.take_names();
    return std::move(surface_);
  }

 private:
  void expect(std::initializer_list<const char*> words) {
    for (const char* word : words) {
      const std::string_view field = fields_.required(quoted(word));
      if (!is_word(field, word)) fields_.fail_found(field, quoted(word));
    }
  }

  void expect_line(std::initializer_list<const char*> words) {
    if (!fields_.next_line()) fields_.fail("the file ends, expected " + quoted(*words.begin()));
    expect(words);
  }

  static std::string quoted(const std::string& word) { return "'" + word + "'"; }

  void read_solid(const std::string& name) {
    const std::string expected = "'facet' or 'endsolid'";
    for (;;) {
      if (!fields_.next_line()) fields_.fail("the file ends, expected " + expected);
      const std::string_view field = fields_.required(expected);
      if (is_word(field, "endsolid")) return;
      if (!is_word(field, "facet")) fields_.fail_found(field, expected);
      // The normal is ignored: it follows from the corners, and some files have wrong ones.
      read_triangle();
      surface_.tags.push_back(tags_.tag_of(name));
    }
  }

  void read_triangle() {
    if (surface_.triangles.size() == kMaxTriangles) fields_.fail(kTooManyTriangles);
    expect_line({"outer", "loop"});
    std::array<std::int32_t, 3> triangle;
    for (std::int32_t& corner : triangle) {
      expect_line({"vertex"});
      const double x = fields_.coordinate("x"), y = fields_.coordinate("y");
      corner = vertices_.index_of({x, y, fields_.coordinate("z")});
    }
    expect_line({"endloop"});
    expect_line({"endfacet"});
    surface_.triangles.push_back(triangle);
  }

  TextFields fields_;
  VertexTable vertices_;
  TagNames tags_;
  SurfaceTriangles surface_;
};

SurfaceTriangles parse_binary(ByteFields fields, std::size_t count) {
  if (count > kMaxTriangles) fields.fail(kTooManyTriangles);
  VertexTable vertices;
  SurfaceTriangles surface;
  surface.triangles.reserve(count);
  for (std::size_t t = 0; t < count; ++t) {
    fields.skip(kNormal);
    std::array<std::int32_t, 3> triangle;
    for (std::int32_t& corner : triangle) {
      const double x = fields.coordinate<float>("x"), y = fields.coordinate<float>("y");
      corner = vertices.index_of({x, y, fields.coordinate<float>("z")});
    }
    surface.triangles.push_back(triangle);
    fields.skip(kTriangle - kNormal - 9 * sizeof(float));
  }
  surface.vertices = vertices.take_points();
  surface.tags.assign(count, 1);
  return surface;
}

bool begins_as_text(std::string_view bytes) {
  TextFields fields(bytes.substr(0, kHeader), "");
  if (!fields.next_line()) return false;
  return is_word(fields.required("a word"), "solid");
}

// Throws an error for a file that is not text, and empty or too short for a binary file with
// `count` triangles.
[[noreturn]] void fail_as_binary(std::string_view bytes, std::size_t count,
                                 const std::string& name) {
  const std::string what =
      begins_as_text(bytes.substr(0, bytes.find('\0')))
          ? ": is binary, though its header begins with 'solid' as text does (it contains a zero "
            "byte), and "
          : ": does not begin with 'solid' as text does, and as a binary file ";
  const std::string there = std::to_string(bytes.size()) + " bytes";
  if (bytes.size() < kBeforeTriangles)
    throw Error(ErrorKind::file, name + what + "it is too short: " + there + ", expected " +
                                     std::to_string(kBeforeTriangles) + " or more");
  const std::size_t expected = kBeforeTriangles + kTriangle * count;
  const std::string whole =
      bytes.size() < expected
          ? "; it is cut short after " +
                std::to_string((bytes.size() - kBeforeTriangles) / kTriangle) + " of them"
          : "";
  throw Error(ErrorKind::file, name + what + "it has " + there + ", expected " +
                                   std::to_string(expected) + " for the " + std::to_string(count) +
                                   " triangles that its header announces" + whole);
}

}  // namespace

// Parses text or binary. A binary file may begin with "solid", too, so the size is checked first.
SurfaceTriangles parse_stl(std::string_view bytes, const std::string& name) {
  const bool has_header = bytes.size() >= kBeforeTriangles;
  ByteFields fields(bytes, has_header ? kHeader : 0, std::endian::little, name);
  const std::size_t count = has_header ? fields.next<std::uint32_t>("a count") : 0;
  const std::size_t expected = kBeforeTriangles + kTriangle * count;
  if (has_header && bytes.size() == expected) return parse_binary(fields, count);
  if (begins_as_text(bytes) && bytes.find('\0') == std::string_view::npos)
    return TextParser(bytes, name).parse();
  if (count == 0 || bytes.size() < expected) fail_as_binary(bytes, count, name);
  SurfaceTriangles surface = parse_binary(fields, count);
  const std::size_t extra = bytes.size() - expected;
  surface.warnings.emplace_back(WarningCode::triangles_left_out,
                                name + ": " + std::to_string(extra) + " bytes behind the " +
                                    std::to_string(count) +
                                    " triangles that the header announces are left out",
                                static_cast<std::int64_t>(extra / kTriangle));
  return surface;
}

}  // namespace pnpbs
