// SPDX-License-Identifier: BSD-3-Clause
// Fields of the caller's in Gmsh's files: a view of values at nodes each.
#pragma once

#include "io/formats.hpp"

namespace pnpbs::io {

// Collective.
void append_node_data(const NodeSource& nodes, SharedFile& file);

}  // namespace pnpbs::io
