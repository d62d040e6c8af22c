// SPDX-License-Identifier: BSD-3-Clause
// The kinds of domains and the dimension of their bubbles.
#pragma once

namespace pnpbs {

// The kind of a domain. Surfaces alone and bodies lie in space.
enum class GeometryKind { plane, sphere, surface, body };

// Returns the dimension of the region that bubbles fill: 3 for bodies, otherwise 2.
constexpr int bubble_dimension(GeometryKind kind) { return kind == GeometryKind::body ? 3 : 2; }

}  // namespace pnpbs
