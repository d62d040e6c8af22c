// SPDX-License-Identifier: BSD-3-Clause
#include "base/execution.hpp"

#include <atomic>

#include "base/kokkos_runtime.hpp"

namespace pnpbs {

void FirstException::store() noexcept {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!first_) first_ = std::current_exception();
}

namespace {

// Made once, because making one allocates, and never destroyed, because Kokkos may end before.
const Exec& execution_space() {
  static const Exec* const space = new Exec;
  return *space;
}

}  // namespace

void for_each_range(const char* label, std::int64_t n,
                    FunctionRef<void(std::int64_t begin, std::int64_t end)> body) {
  if (n <= 0) return;
  require_threads();
  const Exec& space = execution_space();
  const auto ranges = static_cast<std::int64_t>(space.concurrency());
  // Only tools need the label, which would be copied.
  const std::string name = Kokkos::Tools::profileLibraryLoaded() ? label : "";
  std::atomic<bool> started{false};
  const auto run = [&](std::int64_t range) {
    const std::int64_t begin = n * range / ranges;
    const std::int64_t end = n * (range + 1) / ranges;
    if (begin < end) body(begin, end);
  };
  try {
    Kokkos::parallel_for(
        name, Kokkos::RangePolicy<Exec, Kokkos::IndexType<std::int64_t>>(space, 0, ranges),
        [&](std::int64_t range) {
          started.store(true, std::memory_order_relaxed);
          run(range);
        });
  } catch (const std::bad_alloc&) {
    // Kokkos allocates before it starts threads, and after they have ended. A kernel does not fail
    // for that: callers change data in several kernels, all of which have to run.
    for (std::int64_t range = 0; !started && range < ranges; ++range) run(range);
  }
}

}  // namespace pnpbs
