// SPDX-License-Identifier: BSD-3-Clause
// Types of the numbers in binary files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace pnpbs::io {

enum class NumberType { real, real32, int64, int32, int8, uint8 };

constexpr std::size_t size_of(NumberType type) {
  switch (type) {
    case NumberType::real:
    case NumberType::int64:
      return 8;
    case NumberType::real32:
    case NumberType::int32:
      return 4;
    case NumberType::int8:
    case NumberType::uint8:
      return 1;
  }
  return 0;
}

// Returns the type for a C++ type.
template <typename Value>
constexpr NumberType number_type() {
  if constexpr (std::is_same_v<Value, double>) return NumberType::real;
  if constexpr (std::is_same_v<Value, float>) return NumberType::real32;
  if constexpr (std::is_same_v<Value, std::int64_t>) return NumberType::int64;
  if constexpr (std::is_same_v<Value, std::int32_t>) return NumberType::int32;
  if constexpr (std::is_same_v<Value, std::int8_t>) return NumberType::int8;
  if constexpr (std::is_same_v<Value, std::uint8_t>) return NumberType::uint8;
}

}  // namespace pnpbs::io
