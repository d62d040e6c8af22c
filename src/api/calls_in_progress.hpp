// SPDX-License-Identifier: BSD-3-Clause
// Which calls of the interface are in progress, so that Kokkos ends between two of them: a call
// that begins meanwhile is refused.
#pragma once

#include "base/function_ref.hpp"

namespace pnpbs::api {

// Counts as a call of this thread as long as it lives. Calls from inside a callback are part of the
// one that runs the callback.
class CallInProgress {
 public:
  // What a call does that begins while Kokkos ends.
  enum class WhileEnding { throws, waits };

  // Throws Error(ErrorKind::state) then, or waits.
  explicit CallInProgress(WhileEnding while_ending = WhileEnding::throws);
  CallInProgress(const CallInProgress&) = delete;
  CallInProgress& operator=(const CallInProgress&) = delete;
  ~CallInProgress();
};

// Runs `end` when the calls of other threads that are in progress have ended. Throws
// Error(ErrorKind::state) from inside a callback, whose call would never end, and while another
// thread does the same.
void run_between_calls(FunctionRef<void()> end);

}  // namespace pnpbs::api
