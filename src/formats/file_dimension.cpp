// SPDX-License-Identifier: BSD-3-Clause
#include "formats/file_dimension.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "formats/msh_mesh.hpp"
#include "formats/surface_formats.hpp"

namespace pnpbs {

namespace {

// A .poly is Triangle's or TetGen's: the second number of both is the dimension. Only what is
// certainly a body's is said to be one; all else, pipes too, is for the reader of plane domains.
bool has_three_dimensions(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::ifstream file(path);
  std::string line, vertices, dimension;
  while (std::getline(file, line)) {
    std::istringstream words(line.substr(0, line.find('#')));
    if (words >> vertices) return words >> dimension && dimension == "3";
  }
  return false;
}

}  // namespace

int file_dimension(const std::string& path) {
  if (is_msh(path)) return read_msh(path).dimension();
  const auto format = known_surface_format(path);
  if (!format) return 2;
  if (*format == SurfaceFormat::poly) return has_three_dimensions(path) ? 3 : 2;
  return 3;
}

}  // namespace pnpbs
