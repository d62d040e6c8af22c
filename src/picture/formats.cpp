// SPDX-License-Identifier: BSD-3-Clause
#include "picture/formats.hpp"

#include <array>

namespace pnpbs::picture {
namespace {

constexpr std::array table{
    Format{"svg", "a picture, scalable", false, write_svg},
    Format{"png", "a picture in pixels", true, write_png},
};

}  // namespace

std::span<const Format> formats() { return table; }

}  // namespace pnpbs::picture
