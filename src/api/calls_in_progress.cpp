// SPDX-License-Identifier: BSD-3-Clause
#include "api/calls_in_progress.hpp"

#include <condition_variable>
#include <mutex>

#include "base/error.hpp"

namespace pnpbs::api {

namespace {

std::mutex mutex;
std::condition_variable changed;
int threads_in_calls = 0;
bool ending = false;
thread_local int depth = 0;  // nested calls of this thread; above 1 inside a callback

}  // namespace

CallInProgress::CallInProgress(WhileEnding while_ending) {
  if (depth == 0) {
    std::unique_lock<std::mutex> lock(mutex);
    if (ending && while_ending == WhileEnding::throws)
      throw Error(ErrorKind::state,
                  "another thread ends Kokkos by pnpbs_finalize: no call can begin meanwhile");
    changed.wait(lock, [] { return !ending; });
    ++threads_in_calls;
  }
  ++depth;
}

CallInProgress::~CallInProgress() {
  if (--depth > 0) return;
  const std::lock_guard<std::mutex> lock(mutex);
  if (--threads_in_calls == 0) changed.notify_all();
}

void run_between_calls(FunctionRef<void()> end) {
  if (depth > 0)
    throw Error(ErrorKind::state,
                "a computation is in progress: Kokkos cannot be ended from inside a callback");
  std::unique_lock<std::mutex> lock(mutex);
  if (ending) throw Error(ErrorKind::state, "another thread ends Kokkos by pnpbs_finalize already");
  ending = true;
  changed.wait(lock, [] { return threads_in_calls == 0; });
  lock.unlock();
  const auto go_on = [&] {
    lock.lock();
    ending = false;
    changed.notify_all();
  };
  try {
    end();
  } catch (...) {
    go_on();
    throw;
  }
  go_on();
}

}  // namespace pnpbs::api
