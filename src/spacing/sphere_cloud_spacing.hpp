// SPDX-License-Identifier: BSD-3-Clause
// The spacing from values at scattered points of a sphere: that of a cloud, with the azimuthal
// equidistant projection about each place in place of the plane.
#pragma once

#include <cstdint>
#include <optional>

#include "spacing/cloud_spacing.hpp"

namespace pnpbs {

class SphereCloudSpacing : public CloudSpacing<3, 2> {
 public:
  // Of a checked field without triangles, whose points lie on the sphere. Throws as CloudSpacing.
  SphereCloudSpacing(const SphereField& field, double radius);

  // The cap about the points' middle that holds them, wider by the distance that they would have in
  // it on a grid. One point is meant for the whole sphere.
  std::optional<GivenExtent<3>> extent() const override;
  void distance_to_extent(std::int64_t n, const Point<3>* x, double* distances) const override;

 private:
  double radius_;
  Point<3> middle_;  // a direction
  double angle_;     // radians
};

}  // namespace pnpbs
