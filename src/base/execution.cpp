// SPDX-License-Identifier: BSD-3-Clause
#include "base/execution.hpp"

#include "base/kokkos_runtime.hpp"

namespace pnpbs {

void FirstException::store() noexcept {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!first_) first_ = std::current_exception();
}

void for_each_range(const char* label, std::int64_t n,
                    FunctionRef<void(std::int64_t begin, std::int64_t end)> body) {
  if (n <= 0) return;
  require_threads();
  const auto ranges = static_cast<std::int64_t>(Exec().concurrency());
  // Only tools need the label, and without it starting a kernel allocates nothing.
  const std::string name = Kokkos::Tools::profileLibraryLoaded() ? label : "";
  Kokkos::parallel_for(name, Kokkos::RangePolicy<Exec, Kokkos::IndexType<std::int64_t>>(0, ranges),
                       [&](std::int64_t range) {
                         const std::int64_t begin = n * range / ranges;
                         const std::int64_t end = n * (range + 1) / ranges;
                         if (begin < end) body(begin, end);
                       });
}

}  // namespace pnpbs
