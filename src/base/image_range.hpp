// SPDX-License-Identifier: BSD-3-Clause
// Loops over the images of a periodic cell.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace pnpbs {

// Calls visit(image) for all images from `first` to `last` along each axis; along the first axis
// they change fastest. Along each axis `first` must be at most `last`.
template <std::size_t Dim, class Visit>
void for_images(const std::array<std::int32_t, Dim>& first,
                const std::array<std::int32_t, Dim>& last, const Visit& visit) {
  std::array<std::int32_t, Dim> image = first;
  while (true) {
    visit(image);
    std::size_t k = 0;
    for (; k < Dim && image[k] == last[k]; ++k) image[k] = first[k];
    if (k == Dim) return;
    ++image[k];
  }
}

}  // namespace pnpbs
