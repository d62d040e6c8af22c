// SPDX-License-Identifier: BSD-3-Clause
// Common part of the C++ programs that test internals of the library over ranks. It runs the checks
// on groups of ranks with MPI and Kokkos, and reports failures with the rank.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>

#include "base/kokkos_runtime.hpp"
#include "comm/communicator.hpp"
#include "rank_groups.h"

namespace rank_checks {

inline MPI_Comm group = MPI_COMM_NULL;  // communicator of the ranks that run the checks together
inline std::shared_ptr<const pnpbs::Communicator> comm;  // over `group`
inline std::int64_t failures = 0;                        // of this rank, in all rounds

inline void expect(bool condition, const std::string& what) {
  if (condition) return;
  if (++failures <= 10)  // there may be thousands of the same kind
    std::fprintf(stderr, "rank %d of %d: %s\n", comm->rank(), comm->size(), what.c_str());
}

// Runs the checks on each group of each round that the leading arguments describe (rank_groups.h).
// Begins and ends MPI and Kokkos. Returns the exit status of the program.
inline int run_in_groups(int argc, char** argv, const std::function<void()>& checks) {
  MPI_Init(&argc, &argv);
  const int rounds = count_rounds(argv + 1);
  if (rounds < 0) {
    MPI_Finalize();
    return WRONG_ROUNDS;
  }
  auto world = pnpbs::mpi_communicator(MPI_Comm_c2f(MPI_COMM_WORLD));
  pnpbs::start_kokkos(0, world->ranks_on_node(), [] {});
  for (int k = 0; k == 0 || k < rounds; ++k) {
    group = split_into_groups(rounds > 0 ? argv[1 + k] : nullptr);
    if (group != MPI_COMM_NULL) {
      comm = pnpbs::mpi_communicator(MPI_Comm_c2f(group));
      checks();
      comm.reset();
      MPI_Comm_free(&group);
    }
    wait_for_all_ranks();
  }
  const std::uint64_t all = world->allreduce_sum(static_cast<std::uint64_t>(failures));
  if (world->rank() == 0) std::printf("%llu failed\n", static_cast<unsigned long long>(all));
  pnpbs::end_kokkos();
  world.reset();
  MPI_Finalize();
  return all != 0;
}

}  // namespace rank_checks
