// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace pnpbs {

// The kinds of domains. Surfaces alone and bodies are in space.
enum class GeometryKind { plane, sphere, surface, body };

// The dimension of what bubbles fill.
constexpr int bubble_dimension(GeometryKind kind) { return kind == GeometryKind::body ? 3 : 2; }

}  // namespace pnpbs
