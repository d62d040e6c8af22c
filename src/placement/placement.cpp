// SPDX-License-Identifier: BSD-3-Clause
#include "placement/placement.hpp"

#include <algorithm>
#include <string_view>

#include "base/error.hpp"

namespace pnpbs {

// Ranks with different options take part in different collective calls and wait for each other
// without end.
void Placement::require_same_options() const {
  if (!comm_->same_on_all(options_.fingerprint()))
    throw Error(ErrorKind::argument,
                "the options differ between ranks: set the same ones on all of them");
}

// Restores the state from before a failed call. Only the information that a monitor has stopped the
// run is kept.
void Placement::restore_run(RunState before) noexcept {
  const StopReason reason = state_.stop_reason;
  state_ = std::move(before);
  if (reason == StopReason::monitor) state_.stop_reason = reason;
}

// Adds a warning about the changes. A finished run goes on if they affect it: with more steps it
// continues, and with other options, except those for first nodes, it begins again.
void Placement::adopt_changes(const std::vector<OptionChange>& changes) {
  constexpr std::string_view kOfFirstNodes[] = {"levels", "coarsest_steps", "refined_steps"};
  if (changes.empty()) return;
  bool more_steps = false, others = false;
  for (const OptionChange& change : changes) {
    more_steps = more_steps || change.name == "steps";
    others = others || (change.name != "steps" &&
                        std::ranges::find(kOfFirstNodes, std::string_view(change.name)) ==
                            std::end(kOfFirstNodes));
  }
  std::string told = "options changed since the checkpoint: " + text_of(changes);
  if (finished() && others) {
    state_.schedule = state_.schedule.again();
  } else if (finished() && more_steps && state_.stop_reason == StopReason::rest) {
    told += "; the bubbles rest after " + std::to_string(state_.schedule.step) +
            " steps, and more steps change nothing: lower the option tolerance_mean for a run that "
            "continues";
  } else if (finished() && more_steps &&
             state_.schedule.step < options_.in(dimension()).integer("steps")) {
    state_.schedule.progress = Progress::steps;
    state_.schedule.population_settled = false;
    state_.schedule.quiet_events = 0;
  } else if (finished()) {
    told += "; the run has finished, and they have no effect on it";
  }
  state_.warnings.insert(
      state_.warnings.begin() + static_cast<std::ptrdiff_t>(state_.warnings_of_level),
      Warning(WarningCode::options_changed, std::move(told), std::ssize(changes)));
  ++state_.warnings_of_level;
}

}  // namespace pnpbs
