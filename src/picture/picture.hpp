// SPDX-License-Identifier: BSD-3-Clause
// Drawings of plane node sets, spheres and bodies.
#pragma once

#include <string>

#include "base/types.hpp"
#include "picture/body.hpp"
#include "picture/cut_plane.hpp"
#include "picture/element_colour.hpp"
#include "picture/formats.hpp"
#include "picture/node_set.hpp"

namespace pnpbs::picture {

// The view of a sphere about the origin: an orthographic view from far away, or a map.
struct SphereView {
  double radius = 1;
  bool as_map = false;  // plate carrée: longitude to the right, latitude upwards. [degrees]
  Point<2> from{};  // longitude and latitude below the viewer of an orthographic view. [degrees]
};

struct PictureStyle {
  bool bubbles = false;  // draw the bubbles, circles of diameter d; in the plane only
  // The figure that colours the elements. In the plane, discs are drawn if it is `none`.
  ElementColour colour = ElementColour::none;
  std::string unit{};  // of length, for the scale bar; may be empty
};

// Returns a picture of the nodes. `nodes` must outlive the drawing.
Drawing drawing_of(const NodeSet& nodes, const PictureStyle& style);

// Returns a picture of the triangles of a sphere, which are the boundary of `triangles`.
// `triangles` must outlive the drawing.
Drawing drawing_of(const Body& triangles, const SphereView& view, const PictureStyle& style);

// Returns a picture of a body that is cut open. Whole tetrahedra in front of the plane are removed;
// those behind it are coloured. `body` must outlive the drawing.
Drawing drawing_of(const Body& body, const CutPlane& plane, const PictureStyle& style);

}  // namespace pnpbs::picture
