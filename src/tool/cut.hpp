// SPDX-License-Identifier: BSD-3-Clause
// Where pictures cut a body open.
#pragma once

#include <string>

#include "picture/cut_plane.hpp"
#include "tool/library.hpp"

namespace pnpbs::tool {

// Of "x=62" (or y, z) or "a,b,c,d", which means a x + b y + c z = d. Throws BadInput.
picture::CutPlane cut_plane_in(const std::string& text);

// The wanted plane, or, if none is asked for, one through the middle. Throws BadInput if it misses
// the body.
picture::CutPlane cut_plane_for(const std::string& text, pnpbs_domain domain,
                                pnpbs_context context);

}  // namespace pnpbs::tool
