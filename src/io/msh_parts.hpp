// SPDX-License-Identifier: BSD-3-Clause
// Output of a distributed mesh to Gmsh's partitioned files, one for each rank.
#pragma once

#include <string>

#include "comm/communicator.hpp"
#include "mesh/distributed_mesh.hpp"

namespace pnpbs::io {

// Returns Gmsh's name for the file of a rank. Partitions count from 1.
std::string msh_part_path(const std::string& prefix, int rank);

// Writes the files of all ranks, or none. Collective; if one rank throws, all ranks throw.
void write_msh_parts(const Communicator& comm, const DistributedMesh& mesh,
                     const std::string& prefix);

}  // namespace pnpbs::io
