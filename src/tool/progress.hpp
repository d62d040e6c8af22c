// SPDX-License-Identifier: BSD-3-Clause
// The progress bar on standard error, and notes on events that prolong a run. The bar is shown on
// terminals, or everywhere on request.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include "pnpbs/pnpbs.h"

namespace pnpbs::tool {

class Progress {
 public:
  // forced: show the bar even if standard error is not a terminal.
  Progress(bool wanted, bool forced);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Installs the monitor, which draws the bar and lets an interrupt stop the run. It calls
  // turn(fraction, step, stop), which returns whether the run is to stop. This object must outlive
  // the placement.
  using Turn = std::function<bool(double fraction, std::int64_t step, bool stop)>;
  void watch(pnpbs_placement placement, Turn turn);

  void say(const std::string& what);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  static std::int32_t monitor(double fraction, std::int64_t step, std::int64_t nodes,
                              double max_speed, void* user);
  void update(double fraction, std::int64_t step, std::int64_t nodes, double max_speed);
  void note_held_spacing(std::int64_t nodes);
  std::string expected_work(std::int64_t nodes) const;
  void draw(const std::string& line);

  Turn turn_;
  pnpbs_placement placement_ = nullptr;
  std::int64_t unresolved_places_ = 0;  // number reported already
  bool wanted_, shown_;
  bool drawn_ = false;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point last_{};
};

}  // namespace pnpbs::tool
