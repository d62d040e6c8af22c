// SPDX-License-Identifier: BSD-3-Clause
// Single points that the user gives.
#pragma once

#include <cstdint>
#include <string>

#include "base/types.hpp"

namespace pnpbs {

template <int Dim>
struct FixedNode {
  Point<Dim> position;
  std::int32_t tag;
  std::string name;  // for messages: "fixed node 3"
};

// A point whose surroundings are taken out.
template <int Dim>
struct Hole {
  Point<Dim> point;
  std::string name;  // for messages: "hole 0"
};

}  // namespace pnpbs
