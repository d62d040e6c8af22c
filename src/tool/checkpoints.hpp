// SPDX-License-Identifier: BSD-3-Clause
// Checkpoints of a run. They are written at intervals, when the run is stopped, and at its end.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>

#include "pnpbs/pnpbs.h"
#include "tool/ranks.hpp"

namespace pnpbs::tool {

// Interval between checkpoints, in steps or in time. If both are 0, a checkpoint is written only at
// the end.
struct CheckpointInterval {
  std::int64_t steps = 0;
  std::chrono::duration<double> time{0};
};

// Parses "500" (steps), "90s", "30min" or "2h". Throws BadInput.
CheckpointInterval checkpoint_interval_in(const std::string& text);

class Checkpoints {
 public:
  // An empty path disables checkpoints. All arguments must outlive this object.
  Checkpoints(std::string path, CheckpointInterval interval, pnpbs_placement placement,
              pnpbs_context context, const Ranks& ranks)
      : path_(std::move(path)),
        interval_(interval),
        placement_(placement),
        context_(context),
        ranks_(ranks) {}

  // Handles one call of the monitor, and writes a checkpoint if one is due or the run stops.
  // Returns whether the run is to stop. Collective unless `fraction` is 0.
  bool turn(double fraction, std::int64_t step, bool stop);
  // Writes a checkpoint now. Collective. Throws Failure.
  void write();

  // Returns the message for a run that was stopped.
  std::string stop_message() const;

 private:
  using Clock = std::chrono::steady_clock;

  bool is_due(std::int64_t step) const;
  void try_to_write(std::int64_t step);

  std::string path_;
  CheckpointInterval interval_;
  pnpbs_placement placement_;
  pnpbs_context context_;
  const Ranks& ranks_;
  Clock::time_point written_at_ = Clock::now();
  std::int64_t written_step_ = -1;  // step of the last checkpoint of this run
  std::int64_t first_step_ = -1;    // first step that turn() received
  bool warned_ = false;
};

}  // namespace pnpbs::tool
