// SPDX-License-Identifier: BSD-3-Clause
#include "tool/launcher.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace pnpbs::tool {
namespace {

// Open MPI's mpirun; the MPICH family's, Slurm's and others' PMI; MVAPICH's mpirun_rsh.
constexpr const char* tell_number[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MV2_COMM_WORLD_SIZE"};
// PMIx, as srun --mpi=pmix and prterun do; old and other PMI.
constexpr const char* tell_rank[] = {"PMIX_RANK", "PMI_RANK", "PALS_RANKID"};

}  // namespace

Launch launch_of_this_process() {
  Launch launch;
  for (const char* variable : tell_number) {
    const char* value = std::getenv(variable);
    if (value) launch = {true, std::max(launch.processes, std::atoi(value))};
  }
  for (const char* variable : tell_rank) launch.by_mpi |= std::getenv(variable) != nullptr;
  const char* wish = std::getenv("PNPBS_MPI");
  if (wish && std::string_view(wish) == "0") return {};
  if (wish && std::string_view(wish) == "1") launch.by_mpi = true;
  return launch;
}

}  // namespace pnpbs::tool
