// SPDX-License-Identifier: BSD-3-Clause
// What a level stands on: the domain and the spacing; in the plane the boundary discretized at that
// spacing, too, in space the surfaces and the nodes on their feature edges. It never changes.
//
// Ground<2> and Ground<3> have in common: bounds(), measure() (area or volume), spacing(),
// kind(), evaluator(), and boundary(), the facets that the background tree sorts.
#pragma once

#include "level/plane/level_geometry.hpp"
#include "level/volume/level_geometry.hpp"
