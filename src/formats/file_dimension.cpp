// SPDX-License-Identifier: BSD-3-Clause
#include "formats/file_dimension.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>

#include "base/text_lines.hpp"
#include "formats/msh_mesh.hpp"
#include "formats/surface_formats.hpp"

namespace pnpbs {

namespace {

// Returns whether a .poly file declares dimension 3. Both Triangle's and TetGen's format have the
// dimension as second number. All other files, pipes included, are left to the reader of plane
// domains, which then reports what is wrong.
bool has_three_dimensions(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::ifstream file(path);
  std::string text, vertices, dimension;
  while (std::getline(file, text)) {
    for (std::string_view rest = text; !rest.empty();) {
      const std::string_view line = take_line(rest);
      std::istringstream words(std::string(line.substr(0, line.find('#'))));
      if (words >> vertices) return words >> dimension && dimension == "3";
    }
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
