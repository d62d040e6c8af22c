// SPDX-License-Identifier: BSD-3-Clause
// Which triangles bound a body, and which lie inside.
#pragma once

#include <map>

#include "surfaces/triangulation.hpp"

namespace pnpbs {

// Those with a tag that has a role get it. Throws Error(ErrorKind::domain) if no triangle has a tag
// that has a role.
void give_roles(Triangulation& surface, const std::map<std::int32_t, SurfaceRole>& roles);

// A triangle whose role goes by its place bounds the body if what surrounds the surface that it
// belongs to is on one side of it: then closed surfaces within each other bound cavities, and
// sheets and what divides a body are inner. An open surface that nothing encloses stays a boundary,
// for the check of that to tell where it is open. Throws Error(ErrorKind::domain) if triangles
// cross.
void find_roles_by_place(Triangulation& surface);

}  // namespace pnpbs
