// SPDX-License-Identifier: BSD-3-Clause
// The wait policy of OpenMP threads, set so that waiting threads do not occupy cores.
#pragma once

namespace pnpbs::tool {

// Sets how the threads of GCC's OpenMP wait for each other. By default they spin. If the ranks on a
// machine have more threads than it has cores, or other programs use the cores, spinning threads
// block those that they wait for, and a run takes many times as long. OMP_WAIT_POLICY and
// GOMP_SPINCOUNT are read before main begins. So, unless one of them is set, this process executes
// itself again, with threads that sleep at once, or after a short time if there are enough cores.
// Must be called first in main.
void set_wait_policy(char** argv);

}  // namespace pnpbs::tool
