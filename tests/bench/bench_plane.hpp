// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bench_run.hpp"

namespace pnpbs_bench {

// Runs and judges those cases in the plane that are asked for.
void bench_plane(const Arguments& arguments);

}  // namespace pnpbs_bench
