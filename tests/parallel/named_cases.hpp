// SPDX-License-Identifier: BSD-3-Clause
// Runs those cases of a test program that its arguments select by name.
#pragma once

#include <cstdio>
#include <set>
#include <string>

#include "rank_program.h"

// Runs the cases that the arguments name, or all cases if there are no arguments. An unknown name
// is a failure. Collective over the group.
template <class Cases>
void run_named_cases(const Cases& cases) {
  std::set<std::string> named;
  for (char** argument = arguments; *argument; ++argument) named.insert(*argument);
  const bool all = named.empty();
  for (const auto& [name, run] : cases) {
    if (named.erase(name) == 0 && !all) continue;
    const double start = MPI_Wtime();
    run();
    if (rank == 0)
      std::printf("%s: %.1f s, %d failed so far\n", name.c_str(), MPI_Wtime() - start, failures);
  }
  for (const std::string& name : named) expect(0, ("there is no case " + name).c_str());
}
