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

// The execution space is created once because its constructor allocates. It is never destroyed
// because Kokkos may be finalized before static objects are destroyed.
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
  // Only Kokkos tools read the label, and copying it allocates.
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
    // Kokkos allocates before it starts the threads and after they have ended. A kernel must not
    // fail because of that: callers change data in a sequence of kernels, and all of them have to
    // run.
    for (std::int64_t range = 0; !started && range < ranges; ++range) run(range);
  }
}

}  // namespace pnpbs
