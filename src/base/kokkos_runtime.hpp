// SPDX-License-Identifier: BSD-3-Clause
// Start and end of Kokkos, which the host program and this library share.
#pragma once

#include <cstdint>
#include <string>

namespace pnpbs {

// Starts Kokkos with `threads` threads, or adopts the instance of the host program if it has
// started one. If `threads` is 0, the environment determines the number (OMP_NUM_THREADS or
// KOKKOS_NUM_THREADS). Without it, the number is that of the available cores divided by
// `ranks_on_node`. `before_end` is called before Kokkos ends, no matter who ends it, and must
// release all Views. Throws Error(ErrorKind::kokkos) where Kokkos itself would abort the process:
// for an invalid KOKKOS_* variable or a second start.
void start_kokkos(std::int64_t threads, int ranks_on_node, void (*before_end)());

// Throws Error(ErrorKind::kokkos) if Kokkos does not run or has ended. Also throws what
// require_threads() throws.
void require_kokkos();

// Throws Error(ErrorKind::state) if this process was forked from one in which Kokkos had several
// threads. A fork copies only the calling thread, and a kernel would wait forever for the others.
void require_threads();

// Returns true if Kokkos was started in this process, by this library or by the host program.
bool kokkos_was_started();

// Ends Kokkos if this library has started it.
void end_kokkos();

// Returns the number of threads of Kokkos, or 0 if Kokkos does not run.
std::int64_t thread_count();

}  // namespace pnpbs
