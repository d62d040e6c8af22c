// SPDX-License-Identifier: BSD-3-Clause
// The pictures there are.
#pragma once

#include "base/types.hpp"
#include "picture/body.hpp"
#include "picture/cut_plane.hpp"
#include "picture/element_colour.hpp"
#include "picture/formats.hpp"
#include "picture/node_set.hpp"

namespace pnpbs::picture {

// How a sphere about the origin is looked at: from far away, or all of it at once as a map.
struct SphereView {
  double radius = 1;
  bool as_map = false;  // plate carrée: longitude to the right, latitude upwards
  Point<2> from{};      // otherwise orthographic, seen from above this longitude and latitude
};

struct PictureStyle {
  bool bubbles = false;                        // draw every node's bubble, a circle of diameter d
  ElementColour colour = ElementColour::none;  // otherwise triangles instead of nodes
};

// What is drawn must outlive its drawing.
Drawing drawing_of(const NodeSet& nodes, const PictureStyle& style);

// The triangles of a sphere, which are the body's boundary.
Drawing drawing_of(const Body& triangles, const SphereView& view, ElementColour colour);

// A body cut open: what lies before the plane is taken away by whole tetrahedra, and those behind
// it are coloured.
Drawing drawing_of(const Body& body, const CutPlane& plane, ElementColour colour);

}  // namespace pnpbs::picture
