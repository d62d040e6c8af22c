// SPDX-License-Identifier: BSD-3-Clause
//
// The world cut in groups of ranks that run one case at the same time: rank 0 alone is the
// reference, behind it each group with a configuration of its own.
#pragma once

#include <mpi.h>

#include <string>
#include <vector>

#include "run_case.hpp"

namespace hunt {

/** Threads of every rank of the world; the reference has one. */
using Threads = std::vector<int>;

/** Groups that fit into so many ranks behind the reference. */
std::vector<Configuration> random_groups(Random& random, int ranks);

enum class Verdict { same, differs, skipped, failed_check };

struct Comparison {
  Verdict verdict = Verdict::same;
  std::size_t group = 0;  // the first that differs
  int first_rank = 0;     // of it in the world
  // On rank 0 of the world alone: what differs, why it is refused, or what the check says; how many
  // nodes there are, a hash of all results of the reference, and whether the run held d down or
  // ended with PNPBS_NOT_CONFORMING.
  std::string difference, nodes, hash;
  bool held_down = false, not_conforming = false;
};

/** Runs the case on all groups. Collective over the world; the same on all ranks but for the
 *  text. */
Comparison compare(const Case& job, const std::vector<Configuration>& groups,
                   const Settings& extra);

/** The arguments that make the program run this group beside the reference. */
std::string arguments_of(const Configuration& configuration, const int* threads);

}  // namespace hunt
