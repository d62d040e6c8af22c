// SPDX-License-Identifier: BSD-3-Clause
//
// One run of a case on the ranks of a communicator.
#pragma once

#include <mpi.h>

#include "case.hpp"
#include "results.hpp"

namespace hunt {

/** What must not change a bit of the results; threads are the process's. */
struct Configuration {
  int ranks = 1;
  int interval = 0;  // of exchanges; 0: as it is at first
  int metis_seed = 1;
  bool rebalances = false;  // by hand, between the calls
  bool serial = false;      // a context that knows no MPI, on one rank
};

/** Every rank of `ranks` gets the results. Collective there. `extra`: options of this run alone. */
Results run_case(const Case& job, const Configuration& configuration, const Settings& extra,
                 MPI_Comm ranks);

}  // namespace hunt
