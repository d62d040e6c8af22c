// SPDX-License-Identifier: BSD-3-Clause
// From where a body is looked at: from the side that is cut off, turned a little, and from so far
// that lines that are parallel stay so.
#pragma once

#include "base/space_vectors.hpp"
#include "picture/cut_plane.hpp"

namespace pnpbs::picture {

// Of length 1; that of 0 is 0.
Point<3> unit_vector(const Point<3>& v);

class BodyView {
 public:
  explicit BodyView(const CutPlane& plane);

  Point<2> project(const Point<3>& x) const { return {dot(x, right_), dot(x, up_)}; }
  double nearness(const Point<3>& x) const { return dot(x, toward_); }
  bool shows(const Point<3>& normal) const { return dot(normal, toward_) > 0; }

  // How bright a surface is, 0 to 1; its normal has length 1.
  double light(const Point<3>& normal) const;
  double light_on_plane() const { return on_plane_; }

 private:
  Point<3> right_, up_, toward_;  // toward us
  double on_plane_ = 1;
};

}  // namespace pnpbs::picture
