// SPDX-License-Identifier: BSD-3-Clause
//
// Arguments of the command line, and of a line of the file of kept cases, which has the same
// format.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "groups.hpp"

namespace hunt {

struct Arguments {
  CaseSpec spec;
  std::uint64_t first = 0, last = 0;   // numbers; last is not one of them
  double seconds = 0;                  // after which no case begins but the first; 0: no limit
  std::optional<Configuration> group;  // in place of random ones
  std::vector<int> threads;            // of the ranks behind the reference
  Settings extra;                      // options of all but the reference
  std::string kept;                    // file of kept cases
  std::string dump;                    // folder to which the cases are written
  bool shrinks = false, expects_differences = false, tells_all = false;
  std::string error;  // of the arguments themselves
};

/** `defaults` are what the arguments change. */
Arguments parsed(const std::vector<std::string>& words, Arguments defaults);

/** The words of every line of a file but for empty ones and comments. */
std::vector<std::vector<std::string>> lines_of(const std::string& path);

/** The arguments that name this case. */
std::string arguments_of(const CaseSpec& spec);

extern const char* const kUsage;

}  // namespace hunt
