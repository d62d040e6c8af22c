// SPDX-License-Identifier: BSD-3-Clause
// Surfaces as files in each format that can be read.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "formats/surface_triangles.hpp"

namespace surface_files {

using pnpbs::SurfaceFormat;
using pnpbs::SurfaceTriangles;

// Returns a box of 1 by 2 by 0.5 with two triangles on each side. Corners appear in the order of
// the vertices, as in an STL file.
inline SurfaceTriangles box() {
  SurfaceTriangles box;
  box.vertices = {{0, 0, 0},   {1, 2, 0},   {1, 0, 0},   {0, 2, 0},
                  {0, 0, 0.5}, {1, 0, 0.5}, {1, 2, 0.5}, {0, 2, 0.5}};
  box.triangles = {{0, 1, 2}, {0, 3, 1}, {4, 5, 6}, {4, 6, 7}, {0, 2, 5}, {0, 5, 4},
                   {1, 3, 7}, {1, 7, 6}, {2, 1, 6}, {2, 6, 5}, {3, 0, 4}, {3, 4, 7}};
  box.tags.assign(box.triangles.size(), 1);
  return box;
}

template <class Number>
void append(std::string& bytes, Number value, std::endian order = std::endian::little) {
  std::array<char, sizeof(Number)> field = std::bit_cast<std::array<char, sizeof(Number)>>(value);
  if (order != std::endian::native) std::reverse(field.begin(), field.end());
  bytes.append(field.data(), field.size());
}

inline const pnpbs::Point<3>& corner(const SurfaceTriangles& surface,
                                     const std::array<std::int32_t, 3>& triangle, std::size_t k) {
  return surface.vertices[static_cast<std::size_t>(triangle[k])];
}

inline std::string stl_text(const SurfaceTriangles& surface) {
  std::ostringstream text;
  text << "solid\n";
  for (const auto& triangle : surface.triangles) {
    text << "  facet normal 0 0 0\n    outer loop\n";
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& x = corner(surface, triangle, k);
      text << "      vertex " << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
    }
    text << "    endloop\n  endfacet\n";
  }
  text << "endsolid\n";
  return text.str();
}

inline std::string stl_binary(const SurfaceTriangles& surface, std::string header = "box") {
  header.resize(80, '\0');
  append(header, static_cast<std::uint32_t>(surface.triangles.size()));
  for (const auto& triangle : surface.triangles) {
    header.append(12, '\0');
    for (std::size_t k = 0; k < 3; ++k)
      for (const double x : corner(surface, triangle, k)) append(header, static_cast<float>(x));
    header.append(2, '\0');
  }
  return header;
}

inline std::string vertex_lines(const SurfaceTriangles& surface, const std::string& prefix,
                                bool numbered = false) {
  std::ostringstream text;
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    const auto& x = surface.vertices[i];
    text << prefix;
    if (numbered) text << i << ' ';
    text << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
  }
  return text.str();
}

inline std::string face_lines(const SurfaceTriangles& surface, const std::string& prefix,
                              std::int32_t first) {
  std::ostringstream text;
  for (const auto& [a, b, c] : surface.triangles)
    text << prefix << a + first << ' ' << b + first << ' ' << c + first << '\n';
  return text.str();
}

inline std::string off(const SurfaceTriangles& surface) {
  return "OFF\n# a box\n" + std::to_string(surface.vertices.size()) + " " +
         std::to_string(surface.triangles.size()) + " 0\n" + vertex_lines(surface, "") +
         face_lines(surface, "3 ", 0);
}

inline std::string obj(const SurfaceTriangles& surface) {
  return "# a box\n" + vertex_lines(surface, "v ") + face_lines(surface, "f ", 1);
}

inline std::string ply_header(const SurfaceTriangles& surface, const std::string& encoding,
                              const std::string& number) {
  return "ply\nformat " + encoding + " 1.0\ncomment a box\nelement vertex " +
         std::to_string(surface.vertices.size()) + "\nproperty " + number + " x\nproperty " +
         number + " y\nproperty " + number + " z\nelement face " +
         std::to_string(surface.triangles.size()) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

inline std::string ply_text(const SurfaceTriangles& surface) {
  return ply_header(surface, "ascii", "double") + vertex_lines(surface, "") +
         face_lines(surface, "3 ", 0);
}

template <class Number>
std::string ply_binary(const SurfaceTriangles& surface, std::endian order) {
  std::string bytes =
      ply_header(surface, order == std::endian::big ? "binary_big_endian" : "binary_little_endian",
                 sizeof(Number) == 4 ? "float" : "double");
  for (const auto& vertex : surface.vertices)
    for (const double x : vertex) append(bytes, static_cast<Number>(x), order);
  for (const auto& triangle : surface.triangles) {
    append(bytes, std::uint8_t{3});
    for (const std::int32_t i : triangle) append(bytes, i, order);
  }
  return bytes;
}

// TetGen's formats. If the vertices are in a .node file, the surface file has none.
inline std::string node(const SurfaceTriangles& surface) {
  return std::to_string(surface.vertices.size()) + " 3 0 0\n" + vertex_lines(surface, "", true);
}

inline std::string smesh(const SurfaceTriangles& surface, bool with_vertices = true) {
  return (with_vertices ? node(surface) : "0 3 0 0\n") + std::to_string(surface.triangles.size()) +
         " 0\n" + face_lines(surface, "3 ", 0) + "0\n";
}

inline std::string poly(const SurfaceTriangles& surface, bool with_vertices = true) {
  return (with_vertices ? node(surface) : "0 3 0 0\n") + std::to_string(surface.triangles.size()) +
         " 0\n" + face_lines(surface, "1\n3 ", 0) + "0\n";
}

// Returns the surface in every format.
inline std::vector<std::pair<SurfaceFormat, std::string>> all(const SurfaceTriangles& surface) {
  return {{SurfaceFormat::stl, stl_text(surface)},
          {SurfaceFormat::stl, stl_binary(surface)},
          {SurfaceFormat::off, off(surface)},
          {SurfaceFormat::obj, obj(surface)},
          {SurfaceFormat::ply, ply_text(surface)},
          {SurfaceFormat::ply, ply_binary<float>(surface, std::endian::little)},
          {SurfaceFormat::ply, ply_binary<double>(surface, std::endian::big)},
          {SurfaceFormat::poly, poly(surface)},
          {SurfaceFormat::smesh, smesh(surface)}};
}

}  // namespace surface_files
