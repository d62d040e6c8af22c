// SPDX-License-Identifier: BSD-3-Clause
//
// Stands in for sched_yield, which Open MPI calls while a rank waits (mpi_yield_when_idle): sleeps
// instead. With more ranks than cores, the ones that wait then leave these to the ones that
// compute, and a message does not take a whole turn of all of them.
#include <sched.h>
#include <time.h>

extern "C" int sched_yield() noexcept {
  const timespec pause{0, 20000};
  nanosleep(&pause, nullptr);
  return 0;
}
