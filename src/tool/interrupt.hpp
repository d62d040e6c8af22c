// SPDX-License-Identifier: BSD-3-Clause
// Ctrl-C and its kin. While the command reads, a signal ends it at once; while it computes or
// writes, the first signal asks it to stop, and a second one, or five seconds, end it at once: this
// process, that is. An MPI launcher then ends the other ranks, which takes mpirun a second or two.
// Temporary files are removed either way. A process that ends at once says that it was interrupted;
// under a launcher, which signals all ranks, only one that ends after the five seconds does. What
// the ranks of a run make of it is told in ranks.hpp and main.cpp.
#pragma once

namespace pnpbs::tool {

// launched: by an MPI launcher. Such a one ends us a moment after its first signal, ready or not,
// so unfinished files are then removed at once.
void handle_interrupts(bool launched);

// From here on the first signal only asks. until_saved: and no time ends the command, as a
// checkpoint is to be written.
void defer_interrupts(bool until_saved);

// Has a signal come to this process?
bool interrupted();

// Callbacks of the library give up once a signal has come; but from finish_callbacks on, they do
// not: what is saved then needs them.
bool callbacks_give_up();
void finish_callbacks();

// Throws Interrupted if so.
void give_up_if_interrupted();

// While files get their names, signals wait. False if one has come before: then no file may get its
// name. The ranks must agree on it before the first file does.
bool begin_commit();
void end_commit();

}  // namespace pnpbs::tool
