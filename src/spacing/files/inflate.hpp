// SPDX-License-Identifier: BSD-3-Clause
// What zlib packed, unpacked, as most VTK files are packed. zlib is opened when it is needed:
// nearly every system has it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace pnpbs {

// The bytes, which must be as many as told; nothing if they are not, or are damaged. Takes memory
// for no more than that. Throws Error where there is no zlib.
std::optional<std::string> inflated(std::string_view packed, std::size_t bytes);

// No fewer bytes hold so many: at best a bit stands for 258 bytes, and two are needed for each such
// copy.
constexpr bool may_inflate_to(std::size_t packed, std::size_t bytes) {
  constexpr std::size_t kBestRatio = 1032;
  return bytes / kBestRatio <= packed;
}

}  // namespace pnpbs
