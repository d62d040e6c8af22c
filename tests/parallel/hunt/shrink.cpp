// SPDX-License-Identifier: BSD-3-Clause
// Tries reductions of a failing case one after the other and keeps those with which it still fails.

#include "shrink.hpp"

#include "watchdog.hpp"

namespace hunt {

namespace {

// Runs the trial. Replaces the failure by it, and returns true, if it fails as well.
bool still_fails(Failure& failure, Failure trial, const Settings& extra) {
  watch(label_of(trial.spec) + ", shrunk", "");
  const Comparison made = compare(make_case(trial.spec), {trial.configuration}, extra);
  if (made.verdict != Verdict::differs) return false;
  trial.difference = made.difference;
  failure = trial;
  return true;
}

template <class Change>
bool try_with(Failure& failure, const Settings& extra, const Change& change) {
  Failure trial = failure;
  change(trial);
  return still_fails(failure, trial, extra);
}

}  // namespace

bool shrink(Failure& failure, const Settings& extra) {
  if (!still_fails(failure, failure, extra)) return false;
  try_with(failure, extra, [](Failure& trial) { trial.spec.once = true; });
  try_with(failure, extra, [](Failure& trial) { trial.spec.default_options = true; });
  for (int round = 0; round < 4; ++round)
    if (!try_with(failure, extra, [](Failure& trial) { trial.spec.share /= 2; }) &&
        !try_with(failure, extra, [](Failure& trial) { trial.spec.share *= 0.7; }))
      break;
  try_with(failure, extra, [](Failure& trial) { trial.configuration.rebalances = false; });
  try_with(failure, extra, [](Failure& trial) { trial.configuration.interval = 0; });
  const int ranks = failure.configuration.ranks;
  for (int fewer = 2; fewer < ranks && failure.configuration.ranks == ranks; ++fewer)
    for (int seed = 1; seed <= 3 && failure.configuration.ranks == ranks; ++seed)
      try_with(failure, extra, [&](Failure& trial) {
        trial.configuration.ranks = fewer;
        trial.configuration.metis_seed = seed;
      });
  try_with(failure, extra, [](Failure& trial) { trial.configuration.metis_seed = 1; });
  return true;
}

}  // namespace hunt
