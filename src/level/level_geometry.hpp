// SPDX-License-Identifier: BSD-3-Clause
// The geometry of a level: the domain, the spacing, and the discretization of the boundary. In the
// plane that is the boundary divided at this spacing; in space it is the surfaces and the nodes on
// their feature edges. It never changes.
// LevelGeometry<2> and LevelGeometry<3> have these members in common: bounds(), measure() (area or
// volume), spacing(), kind(), evaluator(), and boundary(), the facets that the background tree
// sorts.
#pragma once

#include "level/plane/level_geometry.hpp"
#include "level/volume/level_geometry.hpp"
