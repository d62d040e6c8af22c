// SPDX-License-Identifier: BSD-3-Clause
// All nodes on the first rank, for pictures. Nothing else needs them in one place.
#pragma once

#include "picture/body.hpp"
#include "picture/node_set.hpp"
#include "tool/library.hpp"
#include "tool/ranks.hpp"

namespace pnpbs::tool {

// Nodes by id, elements by the ids of their corners. Empty on the other ranks. Collective.
picture::NodeSet gathered_nodes(pnpbs_placement placement, pnpbs_context context,
                                const Ranks& ranks);
picture::Body gathered_body(pnpbs_placement placement, pnpbs_context context, const Ranks& ranks);

}  // namespace pnpbs::tool
