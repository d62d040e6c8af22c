// SPDX-License-Identifier: BSD-3-Clause
#include "formats/surface_triangles.hpp"

#include <algorithm>
#include <functional>
#include <string_view>

#include "base/error.hpp"
#include "base/extension.hpp"
#include "formats/surface_formats.hpp"
#include "formats/text_fields.hpp"

namespace pnpbs {

namespace {

constexpr std::array<std::pair<std::string_view, SurfaceFormat>, 6> kExtensions{
    {{"stl", SurfaceFormat::stl},
     {"off", SurfaceFormat::off},
     {"obj", SurfaceFormat::obj},
     {"ply", SurfaceFormat::ply},
     {"poly", SurfaceFormat::poly},
     {"smesh", SurfaceFormat::smesh}}};

SurfaceTriangles parse_format(std::string_view bytes, const std::string& name, SurfaceFormat format,
                              const std::function<NodeFile()>& node_file) {
  switch (format) {
    case SurfaceFormat::stl:
      return parse_stl(bytes, name);
    case SurfaceFormat::off:
      return parse_off(bytes, name);
    case SurfaceFormat::obj:
      return parse_obj(bytes, name);
    case SurfaceFormat::ply:
      return parse_ply(bytes, name);
    case SurfaceFormat::poly:
      return parse_tetgen(bytes, name, TetGenFormat::poly, node_file);
    case SurfaceFormat::smesh:
      return parse_tetgen(bytes, name, TetGenFormat::smesh, node_file);
  }
  throw Error(ErrorKind::internal, "there is no such format of surfaces");
}

}  // namespace

SurfaceTriangles parse_surface(std::string_view bytes, const std::string& name,
                               SurfaceFormat format, const std::function<NodeFile()>& node_file) {
  SurfaceTriangles surface = parse_format(bytes, name, format, node_file);
  if (surface.triangles.empty()) throw Error(ErrorKind::file, name + ": holds no triangles");
  return surface;
}

std::optional<SurfaceFormat> known_surface_format(const std::string& path) {
  const std::string extension = extension_of(path);
  const auto known = std::find_if(kExtensions.begin(), kExtensions.end(),
                                  [&](const auto& each) { return each.first == extension; });
  if (known == kExtensions.end()) return std::nullopt;
  return known->second;
}

SurfaceFormat surface_format(const std::string& path) {
  if (const auto known = known_surface_format(path)) return *known;
  throw Error(ErrorKind::file,
              path +
                  ": not known by its ending, expected .stl, .off, .obj, .ply, .poly or "
                  ".smesh");
}

SurfaceTriangles read_surface(const std::string& path) {
  const SurfaceFormat format = surface_format(path);
  return parse_surface(read_whole_file(path), path, format, [&path] {
    const std::string beside = path.substr(0, path.size() - extension_of(path).size()) + "node";
    return NodeFile{read_whole_file(beside), beside};
  });
}

}  // namespace pnpbs
