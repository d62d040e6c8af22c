// SPDX-License-Identifier: BSD-3-Clause
// Checkpoints: a file from which a placement continues on any number of ranks, as if it had not
// been interrupted. The file is a VTKHDF file of the nodes, which ParaView opens, with an
// additional group that only PNPBS reads.
#pragma once

#include <string>

#include "placement/placement.hpp"

namespace pnpbs::io {

// Write or read a checkpoint. Collective; if one rank throws, all ranks throw. After an error the
// existing file, or the placement, is unchanged.
void write_checkpoint(Placement& placement, const std::string& path);
void read_checkpoint(Placement& placement, const std::string& path);

}  // namespace pnpbs::io
