// SPDX-License-Identifier: BSD-3-Clause
// Tags of the outline of a plane domain by location, such as those of the open boundary of a sea.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "domain/plane/plane_domain.hpp"

namespace pnpbs {

// Fills values[n] at n points. Throws Error on failure.
using PlaneFunction = std::function<void(std::int64_t n, const Point<2>* x, double* values)>;

// Gives a tag to the segments of the outline at whose middle `where` is negative, and to smooth
// curves as wholes. The outline consists of the boundary curves that surround the domain; those
// around holes, such as islands, are not part of it unless they touch it. `resolved` is the result
// for these sources. Returns the number of segments and smooth curves that got the tag. Leaves the
// sources unchanged if `where` throws.
std::int64_t tag_outline(std::vector<CurveSource>& sources, const ResolvedDomain& resolved,
                         const PlaneFunction& where, std::int32_t tag);

}  // namespace pnpbs
