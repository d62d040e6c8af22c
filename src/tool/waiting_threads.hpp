// SPDX-License-Identifier: BSD-3-Clause
// How threads wait for each other where there are more of them than cores.
#pragma once

namespace pnpbs::tool {

// The threads of GCC's OpenMP wait by spinning. Where several ranks on a machine have more threads
// than it has cores, they keep those from running that they wait for, and a run takes many times as
// long. How they wait is read from OMP_WAIT_POLICY before main begins: so, unless it is set, this
// process starts anew, with threads that sleep. To be called first of all.
void let_threads_sleep_if_oversubscribed(char** argv);

}  // namespace pnpbs::tool
