// SPDX-License-Identifier: BSD-3-Clause
// A runner of tests that use kernels: Kokkos runs, with two threads, while they do.
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
