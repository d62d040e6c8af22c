// SPDX-License-Identifier: BSD-3-Clause
// What C++ programs over ranks that see the inside of the library share: MPI and Kokkos run while
// the checks do, and what fails is told with the rank.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>

#include "base/kokkos_runtime.hpp"
#include "comm/communicator.hpp"

namespace rank_checks {

inline std::shared_ptr<const pnpbs::Communicator> comm;
inline std::int64_t failures = 0;

inline void expect(bool condition, const std::string& what) {
  if (condition) return;
  if (++failures <= 10)  // of the same kind there may be thousands
    std::fprintf(stderr, "rank %d of %d: %s\n", comm->rank(), comm->size(), what.c_str());
}

// Runs the checks; the exit status of the program.
inline int run(int argc, char** argv, const std::function<void()>& checks) {
  MPI_Init(&argc, &argv);
  comm = pnpbs::mpi_communicator(MPI_Comm_c2f(MPI_COMM_WORLD));
  pnpbs::start_kokkos(0, comm->ranks_on_node(), [] {});
  checks();
  const std::uint64_t all = comm->allreduce_sum(static_cast<std::uint64_t>(failures));
  if (comm->rank() == 0)
    std::printf("%d ranks: %llu failed\n", comm->size(), static_cast<unsigned long long>(all));
  pnpbs::end_kokkos();
  comm.reset();
  MPI_Finalize();
  return all != 0;
}

}  // namespace rank_checks
