// SPDX-License-Identifier: BSD-3-Clause
// The triangles of a picture in the colours of their values.
#pragma once

#include <cairo.h>

#include "picture/picture_frame.hpp"
#include "picture/triangle_values.hpp"

namespace pnpbs::picture {

// Where triangles are too small to be seen, pictures that are no pixels take them as pixels, too:
// their size is bounded then.
void fill_triangles(cairo_t* cairo, const PictureFrame& frame, const TriangleValues& values);

}  // namespace pnpbs::picture
