// SPDX-License-Identifier: BSD-3-Clause
// Runs a suite of tests that use kernels, with Kokkos started for two threads.
#pragma once

#include "base/kokkos_runtime.hpp"
#include "geometry/run_suite.hpp"
#include "quick_assert.hpp"

inline int run_kernel_suite(const char* name, std::initializer_list<const TTest*> tests) {
  pnpbs::start_kokkos(2, 1, [] {});
  const int status = run_suite(name, tests);
  pnpbs::end_kokkos();
  return status;
}
