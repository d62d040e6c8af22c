// SPDX-License-Identifier: BSD-3-Clause
#include "io/formats.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace pnpbs::io {
namespace {

constexpr std::array table{
    Format{"vtu", "VTK unstructured grid: nodes, triangles, id, tag, spacing, quality", true, true,
           false, write_vtu},
    Format{"node", "Triangle's node file, numbered from 1, with boundary markers", false, false,
           false, write_node},
    Format{"csv", "id,x,y,tag,spacing", false, false, false, write_csv},
    Format{"svg", "a picture, scalable", false, true, true, write_svg},
    Format{"png", "a picture in pixels", true, true, true, write_png},
};

std::string in_small_letters(std::string_view text) {
  std::string small(text);
  std::ranges::transform(small, small.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return small;
}

}  // namespace

std::span<const Format> formats() { return table; }

const Format* format_by_name(std::string_view name) {
  const auto found = std::ranges::find(table, in_small_letters(name), &Format::name);
  return found == table.end() ? nullptr : &*found;
}

const Format* format_by_extension(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  if (dot == std::string_view::npos || path.find('/', dot) != std::string_view::npos)
    return nullptr;
  return format_by_name(path.substr(dot + 1));
}

}  // namespace pnpbs::io
