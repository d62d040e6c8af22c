// SPDX-License-Identifier: BSD-3-Clause
// How this process was started, told without MPI: initialising that costs a third of a second,
// which nobody wants who runs one process.
#pragma once

namespace pnpbs::tool {

struct Launch {
  bool by_mpi = false;
  int processes = 0;  // 0: not told
};

// From the variables that launchers set for their processes. PNPBS_MPI=0 or 1 overrides them.
Launch launch_of_this_process();

}  // namespace pnpbs::tool
