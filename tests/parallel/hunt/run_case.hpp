// SPDX-License-Identifier: BSD-3-Clause
//
// One run of a case on the ranks of a communicator.
#pragma once

#include <mpi.h>

#include "case.hpp"
#include "results.hpp"

namespace hunt {

/** Parameters that must not change any bit of the results. The number of threads is that of the
 * process. */
struct Configuration {
  int ranks = 1;
  int interval = 0;  // exchange interval; 0: the default
  int metis_seed = 1;
  bool rebalances = false;  // calls rebalance between the other calls
  bool serial = false;      // uses a serial context, on one rank
};

/** Runs the case and returns the results on every rank of `ranks`. `extra`: options of this run
 * only. Collective over `ranks`. */
Results run_case(const Case& job, const Configuration& configuration, const Settings& extra,
                 MPI_Comm ranks);

}  // namespace hunt
