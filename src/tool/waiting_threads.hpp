// SPDX-License-Identifier: BSD-3-Clause
// How threads wait for each other, so that they leave the cores to those that have work.
#pragma once

namespace pnpbs::tool {

// The threads of GCC's OpenMP wait by spinning. Where the ranks on a machine have more threads than
// it has cores, or other programs keep it busy, they keep those from running that they wait for,
// and a run takes many times as long. How they wait is read from OMP_WAIT_POLICY and GOMP_SPINCOUNT
// before main begins: so, unless one is set, this process starts anew, with threads that sleep at
// once, or, where there are cores for all, soon. To be called first of all.
void let_waiting_threads_sleep(char** argv);

}  // namespace pnpbs::tool
