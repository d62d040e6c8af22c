// SPDX-License-Identifier: BSD-3-Clause
// Parsers of surface formats, one source file for each.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "formats/poly_sections.hpp"
#include "formats/surface_triangles.hpp"

namespace pnpbs {

inline constexpr std::int64_t kMaxVertices = std::numeric_limits<std::int32_t>::max();
inline constexpr const char* kTooManyVertices = "more than 2147483647 vertices";

// Returns the format by the extension, as surface_format(), or nothing if it is unknown.
std::optional<SurfaceFormat> known_surface_format(const std::string& path);

// Returns an error text about a vertex number, where numbers start at 0.
inline std::string no_such_vertex(std::int64_t number, std::int64_t count) {
  return "there is no vertex " + std::to_string(number) +
         (count > 0 ? ", expected 0 to " + std::to_string(count - 1) : "");
}

SurfaceTriangles parse_stl(std::string_view bytes, const std::string& name);
SurfaceTriangles parse_off(std::string_view text, const std::string& name);
SurfaceTriangles parse_obj(std::string_view text, const std::string& name);
SurfaceTriangles parse_ply(std::string_view bytes, const std::string& name);

// TetGen's file formats.
enum class TetGenFormat { poly, smesh };
// Parses a TetGen file. `node_file` may be empty.
SurfaceTriangles parse_tetgen(std::string_view text, const std::string& name, TetGenFormat format,
                              const std::function<NodeFile()>& node_file);

// Parses a file of any of these formats. `name` stands for the file in messages. Throws
// Error(ErrorKind::file), also if there are no triangles.
SurfaceTriangles parse_surface(std::string_view bytes, const std::string& name,
                               SurfaceFormat format, const std::function<NodeFile()>& node_file);

// Tags of names, from 1 in the order of first use. The empty name has a tag, too.
class TagNames {
 public:
  std::int32_t tag_of(const std::string& name) {
    const auto [entry, is_new] =
        tags_.try_emplace(name, static_cast<std::int32_t>(tags_.size() + 1));
    if (is_new && !name.empty()) names_.emplace_back(entry->second, name);
    return entry->second;
  }

  // Returns the nonempty names in the order of their tags.
  std::vector<std::pair<std::int32_t, std::string>> take_names() { return std::move(names_); }

 private:
  std::unordered_map<std::string, std::int32_t> tags_;
  std::vector<std::pair<std::int32_t, std::string>> names_;
};

}  // namespace pnpbs
