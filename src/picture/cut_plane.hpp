// SPDX-License-Identifier: BSD-3-Clause
// Planes that cut a body open for a picture.
#pragma once

#include <string>

#include "base/types.hpp"

namespace pnpbs::picture {

// The plane of points x with normal . x = offset. The part on the side of the normal is removed,
// and the viewer looks from there.
struct CutPlane {
  Point<3> normal;  // of any length except 0
  double offset;
  std::string name;  // as shown in the legend: "x = 62"

  double height(const Point<3>& x) const {
    return normal[0] * x[0] + normal[1] * x[1] + normal[2] * x[2] - offset;
  }
  // Returns whether the plane divides the interior of the box.
  bool meets(const Box<3>& box) const;
};

// Returns the plane at coordinate `place` of an axis, 0 to 2. The viewer looks from +x, -y or +z,
// so that the other axes point right and up.
CutPlane plane_across(int axis, double place);

// Returns the plane through the middle of the box, perpendicular to its shortest extent.
CutPlane middle_plane(const Box<3>& box);

}  // namespace pnpbs::picture
