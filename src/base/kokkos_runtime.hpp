// SPDX-License-Identifier: BSD-3-Clause
// Starting Kokkos, or adopting the host's.
#pragma once

#include <cstdint>
#include <string>

namespace pnpbs {

// Sees to it that Kokkos runs: adopts it if the host has started it, else starts it with `threads`
// threads (0: the environment's choice, else the cores we may use divided by `ranks_on_node`).
// before_end is called when Kokkos is about to end, whoever ends it: it must let go of all Views.
// Throws Error(ErrorKind::kokkos) where Kokkos itself would abort the process: a bad KOKKOS_*
// variable, a second start.
void start_kokkos(std::int64_t threads, int ranks_on_node, void (*before_end)());

// Throws Error(ErrorKind::kokkos) if Kokkos does not run (any more), and as require_threads does.
void require_kokkos();

// Throws Error(ErrorKind::state) if this process was forked from one in which Kokkos had several
// threads: a fork copies the calling thread alone, and a kernel would wait for the others for ever.
void require_threads();

// Did anybody start Kokkos in this process?
bool kokkos_was_started();

// Ends Kokkos if we started it.
void end_kokkos();

std::int64_t thread_count();

}  // namespace pnpbs
