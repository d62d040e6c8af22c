// SPDX-License-Identifier: BSD-3-Clause
// Helpers for the tests of the surface readers.
#pragma once

#include <fstream>
#include <initializer_list>
#include <string>

#include "expect_error.hpp"
#include "formats/surface_formats.hpp"
#include "surface_files.hpp"

using pnpbs::SurfaceFormat;
using pnpbs::SurfaceTriangles;
using Triangles = std::vector<std::array<std::int32_t, 3>>;
using TagNames = std::vector<std::pair<std::int32_t, std::string>>;
using Tags = std::vector<std::int32_t>;

inline SurfaceTriangles read(SurfaceFormat format, const std::string& bytes) {
  return pnpbs::parse_surface(bytes, "x", format, nullptr);
}

inline void expect_file_error(SurfaceFormat format, std::initializer_list<const char*> parts,
                              const std::string& bytes) {
  expect_error(pnpbs::ErrorKind::file, parts, [&] { read(format, bytes); });
}

inline void expect_the_same(const SurfaceTriangles& a, const SurfaceTriangles& b) {
  ck_assert(a.vertices == b.vertices);
  ck_assert(a.triangles == b.triangles);
  ck_assert(a.tags == b.tags);
}

inline std::string work_path(const std::string& name) {
  return std::string(PNPBS_TEST_WORK_DIR "/") + name;
}

inline void write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  ck_assert_msg(at != std::string::npos, "no '%s'", from.c_str());
  return text.replace(at, from.size(), to);
}

inline const SurfaceTriangles box = surface_files::box();
