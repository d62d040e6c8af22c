// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace pnpbs {

// Converts a signed number to an index of a std::vector.
inline std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
inline std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

}  // namespace pnpbs
