// SPDX-License-Identifier: BSD-3-Clause
// A distributed mesh in Gmsh's partitioned files, one of each rank.
#pragma once

#include <string>

#include "comm/communicator.hpp"
#include "mesh/distributed_mesh.hpp"

namespace pnpbs::io {

// The name that Gmsh gives the file of a rank: its partitions count from 1.
std::string msh_part_path(const std::string& prefix, int rank);

// All ranks' files appear, or none. Collective, and agreed.
void write_msh_parts(const Communicator& comm, const DistributedMesh& mesh,
                     const std::string& prefix);

}  // namespace pnpbs::io
