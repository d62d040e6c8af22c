// SPDX-License-Identifier: BSD-3-Clause
//
// Arguments of the command line, and of a line in the file of kept cases, which has the same
// format.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "groups.hpp"

namespace hunt {

struct Arguments {
  CaseSpec spec;
  std::uint64_t first = 0, last = 0;   // case numbers; last is excluded
  double seconds = 0;                  // no further case begins after this time; 0: no limit
  std::optional<Configuration> group;  // replaces the random groups
  std::vector<int> threads;            // one number for each rank after the reference
  Settings extra;                      // options of all groups except the reference
  std::string kept;                    // file of kept cases
  std::string dump;                    // folder to which cases are written
  bool shrinks = false, expects_differences = false, tells_all = false;
  std::string error;  // error in the arguments themselves; empty if there is none
};

/** Parses arguments, which override `defaults`. */
Arguments parsed(const std::vector<std::string>& words, Arguments defaults);

/** Returns the words of every line of a file, without empty lines and comments. */
std::vector<std::vector<std::string>> lines_of(const std::string& path);

/** Returns the arguments that select this case. */
std::string arguments_of(const CaseSpec& spec);

extern const char* const kUsage;

}  // namespace hunt
