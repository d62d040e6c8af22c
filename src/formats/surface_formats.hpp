// SPDX-License-Identifier: BSD-3-Clause
// The parsers of the formats of surfaces, each in a file of its own.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

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

}  // namespace pnpbs
