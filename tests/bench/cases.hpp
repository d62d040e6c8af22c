// SPDX-License-Identifier: BSD-3-Clause
// Domains and spacings of pnpbs-bench in the plane.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace pnpbs_bench {

using Loop = std::vector<std::array<double, 2>>;

struct Case {
  std::string name;
  std::string poly;         // a file; empty: use the loops
  std::vector<Loop> loops;  // the first is the outline, the others are holes
  std::function<double(double, double)> d;
  bool constant = false;
  bool in_study = false;  // of the bands of d; runs only if named
};

// Returns the benchmark's own cases, then those of the study: squares graded from a line, a side, a
// point and two points, with growth 0.02 to 0.2 and ratio 10 to 1000 ("bands-line-0.1-100").
std::vector<Case> all_cases();

}  // namespace pnpbs_bench
