// SPDX-License-Identifier: BSD-3-Clause
//
// A case: a body, a spacing, options and the calls of a run. It depends only on the seed and the
// number, or is read from a file. A specification also contains the reductions of a shrunk case.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "body.hpp"
#include "spacing.hpp"

namespace hunt {

enum class Dimensions { both, plane, space };

using Settings = std::vector<std::pair<std::string, std::string>>;

struct CaseSpec {
  std::uint64_t seed = 1, number = 0;
  std::string replay;  // file of a written case; empty: use the seed and the number
  Dimensions dimensions = Dimensions::both;
  std::vector<std::string> files;  // bodies are read from these files, if there are any
  std::string data;                // folder of the examples' bodies, "" for none
  // Reductions of a shrunk case: no second spacing and no single steps, default options, and a
  // fraction of the nodes.
  bool once = false, default_options = false;
  double share = 1;
  // Replaces the random spacing by "d = 1 + slope * distance from the point", and the number of
  // nodes.
  bool is_explicit = false;
  double slope = 0, nodes = 0;
  Point from{};
  Settings options;  // in addition to the random ones
};

struct Case {
  std::uint64_t seed = 1, number = 0;  // determine the random groups
  std::string name;
  Body body;
  Spacing spacing, second;
  Settings options;
  bool adapts = false;     // runs again with the second spacing
  bool at_nodes = false;   // gives the second spacing as values at nodes
  bool by_steps = false;   // initialise, step and adjust_population before the first run
  std::int64_t steps = 0;  // of each step call
  double wanted_nodes = 0;
};

/** Builds the case. Throws std::runtime_error if a file is missing or cannot be read. */
Case make_case(const CaseSpec& spec);

/** Returns the name of the case in reports: the seed and the number, or the file name without its
 * extension. */
std::string label_of(const CaseSpec& spec);

Settings random_options(Random& random, int dim);

}  // namespace hunt
