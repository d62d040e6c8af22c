// SPDX-License-Identifier: BSD-3-Clause
// A RankFile by MPI-IO, which knows how to share a file over the network; only in builds with MPI.
#pragma once

#include <mpi.h>

#include "parallel/rank_file.hpp"

namespace pnpbs {

// The file must exist. Collective. Throws Error(PNPBS_ERROR_FILE), not always on all ranks.
std::unique_ptr<RankFile> open_by_mpi(MPI_Comm comm, const std::string& path,
                                      const std::string& name);

}  // namespace pnpbs
