// SPDX-License-Identifier: BSD-3-Clause
//
// Division of MPI_COMM_WORLD into groups that run one case at the same time. Rank 0 is the
// reference; each group after it has its own configuration.
#pragma once

#include <mpi.h>

#include <string>
#include <vector>

#include "run_case.hpp"

namespace hunt {

/** Number of threads of every rank of the world; the reference has one. */
using Threads = std::vector<int>;

/** Returns random groups that fit into this number of ranks after the reference. */
std::vector<Configuration> random_groups(Random& random, int ranks);

enum class Verdict { same, differs, skipped, failed_check };

struct Comparison {
  Verdict verdict = Verdict::same;
  std::size_t group = 0;  // the first one that differs
  int first_rank = 0;     // of this group in the world
  // Set on rank 0 of the world only: the difference, the reason of a rejection or the message of
  // the check; the number of nodes; a hash of all results of the reference; and whether the run
  // held d down or ended with PNPBS_NOT_CONFORMING.
  std::string difference, nodes, hash;
  bool held_down = false, not_conforming = false;
};

/** Runs the case on all groups. Collective over the world. The result is the same on all ranks
 * except for the texts. */
Comparison compare(const Case& job, const std::vector<Configuration>& groups,
                   const Settings& extra);

/** Returns the arguments that run this group beside the reference. */
std::string arguments_of(const Configuration& configuration, const int* threads);

}  // namespace hunt
