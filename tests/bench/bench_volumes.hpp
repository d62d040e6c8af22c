// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bench_run.hpp"

namespace pnpbs_bench {

// Runs and judges those cases in space that are asked for.
void bench_volumes(const Arguments& arguments);

}  // namespace pnpbs_bench
