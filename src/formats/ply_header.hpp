// SPDX-License-Identifier: BSD-3-Clause
// The header of a PLY file, which says what is in the rest: G. Turk, "The PLY Polygon File Format"
// (1994), with the names of types that came later.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "formats/text_fields.hpp"

namespace pnpbs {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

inline bool is_integer(PlyType type) {
  return type != PlyType::float32 && type != PlyType::float64;
}

struct PlyProperty {
  std::string name;
  PlyType type;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  // of a list
};

struct PlyElement {
  std::string name;
  std::int64_t count;
  std::vector<PlyProperty> properties;

  // Its place among the properties; as many as there are if it is none of them.
  std::size_t place_of(std::string_view property) const;
};

enum class PlyEncoding { text, little_endian, big_endian };

struct PlyHeader {
  PlyEncoding encoding;
  std::vector<PlyElement> elements;
};

// Leaves the fields at the end of the header's last line.
PlyHeader parse_ply_header(TextFields& fields);

}  // namespace pnpbs
