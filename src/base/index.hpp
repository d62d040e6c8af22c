// SPDX-License-Identifier: BSD-3-Clause
// Conversion of signed numbers to indices of a std::vector.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pnpbs {

inline std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
inline std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

}  // namespace pnpbs
