// SPDX-License-Identifier: BSD-3-Clause
// What pnpbs-bench does alike in the plane and in space: runs, their times, their memory.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "pnpbs/pnpbs.h"

namespace pnpbs_bench {

struct Arguments {
  std::string data = "examples/data";
  double scale = 1;      // of every spacing
  double nodes = 70000;  // about so many in each case in space, at scale 1
  int repeat = 1;
  bool judge = true;
  std::vector<std::pair<std::string, std::string>> options;
  std::vector<std::string> names;

  // Is a case asked for? A name that ends with "-" stands for all cases that begin with it; none
  // for all that are not part of a study.
  bool wants(const std::string& name, bool in_study) const;
};

// The one process of all runs; ends with a message where something fails.
pnpbs_context bench_context();
void require_ok(pnpbs_status status, const char* what);

// Places nodes `repeat` times and prints a line of what it took; hands over the last placement.
struct Job {
  std::string name;
  int dimension = 2;
  std::function<void(pnpbs_domain)> fill_domain;
  std::function<void(pnpbs_placement)> set_spacing;
  std::function<void(pnpbs_domain, pnpbs_placement)> judge;
};
void run(const Job& job, const Arguments& arguments);

}  // namespace pnpbs_bench
