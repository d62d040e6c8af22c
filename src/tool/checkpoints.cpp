// SPDX-License-Identifier: BSD-3-Clause
#include "tool/checkpoints.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iostream>

#include "tool/exit.hpp"
#include "tool/interrupt.hpp"
#include "tool/library.hpp"

namespace pnpbs::tool {

CheckpointInterval checkpoint_interval_in(const std::string& text) {
  const auto refuse = [&]() -> CheckpointInterval {
    throw BadInput(
        "--checkpoint-every: expected a number of steps, or a time such as 90s, 30min or 2h, "
        "found '" +
        text + "'");
  };
  const char* const end = text.data() + text.size();
  double number = 0;
  const auto read = std::from_chars(text.data(), end, number);
  if (read.ec != std::errc() || !std::isfinite(number) || number <= 0) return refuse();
  const std::string unit(read.ptr, end);
  CheckpointInterval interval;
  if (unit.empty() && number == std::floor(number) && number < 1e15)
    interval.steps = static_cast<std::int64_t>(number);
  else if (unit == "s" || unit == "min" || unit == "h")
    interval.time = std::chrono::duration<double>(number * (unit == "s"     ? 1
                                                            : unit == "min" ? 60
                                                                            : 3600));
  else
    return refuse();
  return interval;
}

// With an interval in steps, checkpoints are due at the same steps in every run and after a
// restart.
bool Checkpoints::is_due(std::int64_t step) const {
  if (interval_.steps > 0) {
    const std::int64_t last = std::max(first_step_, written_step_);
    return step / interval_.steps > last / interval_.steps;
  }
  return interval_.time.count() > 0 && Clock::now() - written_at_ >= interval_.time;
}

bool Checkpoints::turn(double fraction, std::int64_t step, bool stop) {
  if (path_.empty() || fraction == 0) return stop;  // a call that is not collective
  finish_callbacks();
  if (first_step_ < 0) first_step_ = step;
  stop = ranks_.any(stop);
  if (ranks_.any(stop || is_due(step))) try_to_write(step);
  return stop;
}

// Some events do not allow a checkpoint (PNPBS_ERROR_STATE). The file then stays as it is, and the
// next event tries again.
void Checkpoints::try_to_write(std::int64_t step) {
  const pnpbs_status status = pnpbs_placement_write_checkpoint(placement_, path_.c_str());
  if (status == PNPBS_ERROR_STATE) return;
  written_at_ = Clock::now();
  if (status == PNPBS_OK) {
    written_step_ = step;
  } else if (!warned_ && ranks_.is_first()) {
    std::cerr << "pnpbs: warning: " << pnpbs_last_error(context_) << "\n";
    warned_ = true;
  }
}

void Checkpoints::write() {
  if (!path_.empty()) check(pnpbs_placement_write_checkpoint(placement_, path_.c_str()), context_);
}

std::string Checkpoints::stop_message() const {
  if (written_step_ < 0) return "interrupted, nothing was written";
  return "interrupted; --restart '" + path_ + "' continues from step " +
         std::to_string(written_step_);
}

}  // namespace pnpbs::tool
