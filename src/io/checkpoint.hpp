// SPDX-License-Identifier: BSD-3-Clause
// Checkpoints: one file from which a placement goes on, on any number of ranks, as if it had never
// been interrupted. It is a VTKHDF file of the nodes, which ParaView opens, with a group of its own
// for what only PNPBS asks for.
#pragma once

#include <string>

#include "placement/placement.hpp"

namespace pnpbs::io {

// Collective, both. What fails leaves the file, or the placement, as it was.
void write_checkpoint(Placement& placement, const std::string& path);
void read_checkpoint(Placement& placement, const std::string& path);

}  // namespace pnpbs::io
