// SPDX-License-Identifier: BSD-3-Clause
// Common part of pnpbs-bench in the plane and in space: runs, their times and their memory.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "pnpbs/pnpbs.h"

namespace pnpbs_bench {

struct Arguments {
  std::string data = "examples/data";
  double scale = 1;      // factor of every spacing
  double nodes = 70000;  // approximate number in each case in space, at scale 1
  int repeat = 1;
  bool judge = true;
  std::vector<std::pair<std::string, std::string>> options;
  std::vector<std::string> names;

  // Returns whether a case is selected. A name that ends with "-" selects all cases with this
  // prefix. Without names, all cases outside the study are selected.
  bool wants(const std::string& name, bool in_study) const;
};

// Returns the context of all runs, with one process. Ends the program with a message on an error.
pnpbs_context bench_context();
void require_ok(pnpbs_status status, const char* what);

// Places nodes `repeat` times, prints a line with the cost, and passes the last placement to
// `judge`.
struct Job {
  std::string name;
  int dimension = 2;
  std::function<void(pnpbs_domain)> fill_domain;
  std::function<void(pnpbs_placement)> set_spacing;
  std::function<void(pnpbs_domain, pnpbs_placement)> judge;
};
void run(const Job& job, const Arguments& arguments);

}  // namespace pnpbs_bench
