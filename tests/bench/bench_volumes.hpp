// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bench_run.hpp"

namespace pnpbs_bench {

// Runs and evaluates the selected cases in space.
void bench_volumes(const Arguments& arguments);

}  // namespace pnpbs_bench
