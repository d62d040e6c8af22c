// SPDX-License-Identifier: BSD-3-Clause
// The parsers of the formats of surfaces, each in a file of its own.
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

// As surface_format, but nothing for other endings.
std::optional<SurfaceFormat> known_surface_format(const std::string& path);

// What to say of vertices that are numbered from 0.
inline std::string no_such_vertex(std::int64_t number, std::int64_t count) {
  return "there is no vertex " + std::to_string(number) +
         (count > 0 ? ", expected 0 to " + std::to_string(count - 1) : "");
}

SurfaceTriangles parse_stl(std::string_view bytes, const std::string& name);
SurfaceTriangles parse_off(std::string_view text, const std::string& name);
SurfaceTriangles parse_obj(std::string_view text, const std::string& name);
SurfaceTriangles parse_ply(std::string_view bytes, const std::string& name);

// TetGen's. `node_file` may be empty.
enum class TetGenFormat { poly, smesh };
SurfaceTriangles parse_tetgen(std::string_view text, const std::string& name, TetGenFormat format,
                              const std::function<NodeFile()>& node_file);

// One of these. Throws Error(ErrorKind::file) where there are no triangles. `name` stands for the
// file in messages.
SurfaceTriangles parse_surface(std::string_view bytes, const std::string& name,
                               SurfaceFormat format, const std::function<NodeFile()>& node_file);

// Tags for names, from 1 in the order in which they are asked for. No name ("") is one, too.
class TagNames {
 public:
  std::int32_t tag_of(const std::string& name) {
    const auto [entry, is_new] =
        tags_.try_emplace(name, static_cast<std::int32_t>(tags_.size() + 1));
    if (is_new && !name.empty()) names_.emplace_back(entry->second, name);
    return entry->second;
  }

  // Those that are not empty, by tag.
  std::vector<std::pair<std::int32_t, std::string>> take_names() { return std::move(names_); }

 private:
  std::unordered_map<std::string, std::int32_t> tags_;
  std::vector<std::pair<std::int32_t, std::string>> names_;
};

}  // namespace pnpbs
