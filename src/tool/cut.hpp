// SPDX-License-Identifier: BSD-3-Clause
// The plane along which pictures cut a body open.
#pragma once

#include <string>

#include "picture/cut_plane.hpp"
#include "tool/library.hpp"

namespace pnpbs::tool {

// Parses "x=62" (or y, z) or "a,b,c,d", which means a x + b y + c z = d. Throws BadInput.
picture::CutPlane cut_plane_in(const std::string& text);

// Returns the plane given by `text`, or one through the middle of the body if `text` is empty.
// Throws BadInput if the plane misses the body.
picture::CutPlane cut_plane_for(const std::string& text, pnpbs_domain domain,
                                pnpbs_context context);

}  // namespace pnpbs::tool
