// SPDX-License-Identifier: BSD-3-Clause
//
// A case: a body, a spacing, options and the calls of a run. It is a pure function of the seed and
// the number, or read from a file. A specification also says what a shrunk case leaves out.
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
  std::string replay;  // file of a written case; empty: the case is made of the seed and the number
  Dimensions dimensions = Dimensions::both;
  std::vector<std::string> files;  // if there are any, the bodies are these
  std::string data;                // folder of the examples' bodies, "" for none
  // Shrunk: without the second spacing or steps by hand, with options as they are at first, with
  // a part of the nodes.
  bool once = false, default_options = false;
  double share = 1;
  // "d = 1 + slope * distance from the point" and so many nodes, in place of what is random.
  bool is_explicit = false;
  double slope = 0, nodes = 0;
  Point from{};
  Settings options;  // besides the random ones
};

struct Case {
  std::uint64_t seed = 1, number = 0;  // from which random groups follow
  std::string name;
  Body body;
  Spacing spacing, second;
  Settings options;
  bool adapts = false;     // runs again with the second spacing
  bool at_nodes = false;   // which is given by values at the nodes
  bool by_steps = false;   // initialise, step and adjust_population before the first run
  std::int64_t steps = 0;  // of each step call
  double wanted_nodes = 0;
};

/** Throws std::runtime_error if a file of the case is missing or cannot be read. */
Case make_case(const CaseSpec& spec);

/** Name of the case in reports: the seed and the number, or the file's name without its ending. */
std::string label_of(const CaseSpec& spec);

Settings random_options(Random& random, int dim);

}  // namespace hunt
