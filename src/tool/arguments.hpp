// SPDX-License-Identifier: BSD-3-Clause
// What the user asks for.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "picture/triangle_values.hpp"

namespace pnpbs::tool {

struct Arguments {
  std::string domain;        // a file, or "-"
  std::string spacing;       // a formula; empty if spacing_grid is set
  std::string spacing_grid;  // a file
  std::vector<std::string> outputs;
  std::string format;  // of standard output and of unknown extensions
  std::string report;  // a file, "-", or empty
  std::vector<std::pair<std::string, std::string>> options;        // key and value for the library
  picture::TriangleColour colour = picture::TriangleColour::none;  // of triangles in pictures
  bool bubbles = false;
  bool check = false;  // the results
  bool nodes_only = false;
  bool dry_run = false;
  bool quiet = false;
  bool progress = false;
};

// Parses the command line. If it only wants information (--help, --version, ...), that is the
// result; otherwise it is empty. Throws BadInput.
std::string parse_arguments(int argc, char** argv, Arguments& arguments);

}  // namespace pnpbs::tool
