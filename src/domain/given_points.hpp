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

// A point that stands for the region around it, up to the next curves or surfaces: which is taken
// out, or gets a tag.
template <int Dim>
struct RegionPoint {
  Point<Dim> point;
  std::string name;      // for messages: "hole 0", "region 2"
  std::int32_t tag = 0;  // 0 of holes
  // A file's: where it lies in no region of the domain, or in one with another tag, it does not
  // count, with a warning. Others are errors then.
  bool from_file = false;

  bool is_hole() const { return tag == 0; }
};

}  // namespace pnpbs
