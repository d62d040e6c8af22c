// SPDX-License-Identifier: BSD-3-Clause
// Decompression of zlib data, as in most VTK files. zlib is opened at run time when it is needed;
// nearly every system has it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace pnpbs {

// Decompresses data that must have exactly `bytes` bytes. Returns nothing if the size differs or
// the data are damaged. Allocates no more than `bytes` bytes. Throws Error if zlib cannot be
// opened.
std::optional<std::string> inflated(std::string_view packed, std::size_t bytes);

// Returns whether `packed` bytes may decompress to `bytes` bytes. In the best case a copy of 258
// bytes takes two bits.
constexpr bool may_inflate_to(std::size_t packed, std::size_t bytes) {
  constexpr std::size_t kBestRatio = 1032;
  return bytes / kBestRatio <= packed;
}

}  // namespace pnpbs
