// SPDX-License-Identifier: BSD-3-Clause
// The plane that cuts a body open.
#pragma once

#include <string>

#include "base/types.hpp"

namespace pnpbs::picture {

// Points x with normal . x = offset. What is on the side of the normal is taken away, and seen from
// there.
struct CutPlane {
  Point<3> normal;  // of any length but 0
  double offset;
  std::string name;  // as people write it: "x = 62"

  double height(const Point<3>& x) const {
    return normal[0] * x[0] + normal[1] * x[1] + normal[2] * x[2] - offset;
  }
  // Whether a part of the box lies on either side.
  bool meets(const Box<3>& box) const;
};

// Square to an axis, 0 to 2, and looked at so that the other axes point right and up: from +x, -y
// and +z.
CutPlane plane_across(int axis, double place);

// Through the middle, square to the shortest extent.
CutPlane middle_plane(const Box<3>& box);

}  // namespace pnpbs::picture
