// SPDX-License-Identifier: BSD-3-Clause
// Handling of Ctrl-C and other signals.
//
// While the command reads its input, a signal ends the process at once. While it computes or
// writes, the first signal requests a stop; a second signal, or five seconds, end this process at
// once. An MPI launcher then ends the other ranks, which takes mpirun a second or two. Temporary
// files are removed in all cases. A process that ends at once reports that it was interrupted;
// under a launcher, which signals all ranks, only a process that ends after the five seconds does.
// ranks.hpp and main.cpp describe how the ranks of a run stop together.
#pragma once

namespace pnpbs::tool {

// Installs the signal handlers. `launched` means that an MPI launcher started this process.
// Launchers kill the process a moment after the first signal, so unfinished files are then removed
// at once.
void handle_interrupts(bool launched);

// From this call on, the first signal only requests a stop. With `until_saved` there is no time
// limit, because a checkpoint is to be written.
void defer_interrupts(bool until_saved);

// Returns whether this process has received a signal.
bool interrupted();

// Returns whether callbacks of the library are to fail: after a signal, until finish_callbacks is
// called. Writing a checkpoint requires working callbacks.
bool callbacks_give_up();
void finish_callbacks();

// Throws Interrupted if this process has received a signal.
void give_up_if_interrupted();

// Blocks the effect of signals while files are renamed to their final names. Returns false if a
// signal was received before; then no file may be renamed. All ranks must agree on the result
// before the first file is renamed.
bool begin_commit();
void end_commit();

}  // namespace pnpbs::tool
