// SPDX-License-Identifier: BSD-3-Clause
// Registration of the calls of the interface that are in progress. It lets Kokkos end between two
// calls; a call that begins while Kokkos ends is refused.
#pragma once

#include "base/function_ref.hpp"

namespace pnpbs::api {

// A call of this thread that is in progress while the object exists. A call from inside a callback
// is part of the call that runs the callback.
class CallInProgress {
 public:
  // Behaviour of a call that begins while Kokkos ends.
  enum class WhileEnding { throws, waits };

  // Registers a call. While Kokkos ends, throws Error(ErrorKind::state) or waits until it has
  // ended.
  explicit CallInProgress(WhileEnding while_ending = WhileEnding::throws);
  CallInProgress(const CallInProgress&) = delete;
  CallInProgress& operator=(const CallInProgress&) = delete;
  ~CallInProgress();
};

// Runs `end` after the calls in progress on other threads have ended. Throws
// Error(ErrorKind::state) from inside a callback, whose own call would never end, and while another
// thread runs this function.
void run_between_calls(FunctionRef<void()> end);

}  // namespace pnpbs::api
