// SPDX-License-Identifier: BSD-3-Clause
// Checkpoints of a run: every so often, when it is asked to stop, and at its end.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>

#include "pnpbs/pnpbs.h"
#include "tool/ranks.hpp"

namespace pnpbs::tool {

// From one to the next: so many steps, or so much time; neither: only at the end.
struct CheckpointInterval {
  std::int64_t steps = 0;
  std::chrono::duration<double> time{0};
};

// "500" steps, or "90s", "30min", "2h". Throws BadInput.
CheckpointInterval checkpoint_interval_in(const std::string& text);

class Checkpoints {
 public:
  // An empty path: none are written. All must outlive this object.
  Checkpoints(std::string path, CheckpointInterval interval, pnpbs_placement placement,
              pnpbs_context context, const Ranks& ranks)
      : path_(std::move(path)),
        interval_(interval),
        placement_(placement),
        context_(context),
        ranks_(ranks) {}

  // The monitor's turn at a step, on all ranks or, with fraction 0, on any of them; whether the run
  // is to stop.
  bool turn(double fraction, std::int64_t step, bool stop);
  // Writes one now; throws Failure. Collective.
  void write();

  // What is told of a run that was stopped.
  std::string words_at_stop() const;

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
  std::int64_t written_step_ = -1;  // of this run's last one
  std::int64_t first_step_ = -1;    // that a turn told
  bool warned_ = false;
};

}  // namespace pnpbs::tool
