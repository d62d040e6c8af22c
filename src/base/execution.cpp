// SPDX-License-Identifier: BSD-3-Clause
#include "base/execution.hpp"

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
  // Only tools need the label. Without it, starting a kernel allocates nothing.
  const std::string name = Kokkos::Tools::profileLibraryLoaded() ? label : "";
  Kokkos::parallel_for(name,
                       Kokkos::RangePolicy<Exec, Kokkos::IndexType<std::int64_t>>(space, 0, ranges),
                       [&](std::int64_t range) {
                         const std::int64_t begin = n * range / ranges;
                         const std::int64_t end = n * (range + 1) / ranges;
                         if (begin < end) body(begin, end);
                       });
}

}  // namespace pnpbs
