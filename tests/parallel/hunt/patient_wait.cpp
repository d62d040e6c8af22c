// SPDX-License-Identifier: BSD-3-Clause
//
// Replaces sched_yield, which Open MPI calls while a rank waits (mpi_yield_when_idle), by a sleep.
// With more ranks than cores, waiting ranks then release the cores to those that compute, and a
// message does not take a time slice of all of them.
#include <sched.h>
#include <time.h>

extern "C" int sched_yield() noexcept {
  const timespec pause{0, 20000};
  nanosleep(&pause, nullptr);
  return 0;
}
