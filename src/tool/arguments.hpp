// SPDX-License-Identifier: BSD-3-Clause
// What the user asks for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/types.hpp"
#include "picture/element_colour.hpp"
#include "tool/checkpoints.hpp"
#include "tool/depth_request.hpp"

namespace pnpbs::tool {

constexpr double default_feature_angle = 40;  // degrees
constexpr int default_wall_layers = 3;

// Around this point, which has as many coordinates as the domain.
struct Region {
  std::vector<double> point;
  std::int32_t tag;
  std::string text;  // as the user gives it
};

// Of which a domain is the part that coasts bound.
struct SphereRequest {
  double radius;
  Point<2> outside;  // longitude and latitude of a point that is not in the domain
};

struct ViewRequest {
  bool as_map;
  Point<2> from;  // longitude and latitude
};

struct Arguments {
  std::string domain;                      // a file, "-", or a body in words
  std::string spacing;                     // a formula; may be empty with a grid
  std::vector<std::string> spacing_grids;  // files, or NAME=FILE
  std::optional<DepthRequest> depth_rule;
  std::optional<double> min_spacing, max_spacing;  // of d that no formula gives
  std::vector<std::string> outputs;
  std::string format;               // of standard output and of unknown extensions
  std::string report;               // a file, "-", or empty
  std::string checkpoint, restart;  // files, or empty
  CheckpointInterval checkpoint_interval;
  std::vector<std::pair<std::string, std::string>> options;  // key and value for the library
  std::optional<double> feature_angle;                       // of surfaces, degrees
  std::optional<double> corner_angle;                        // of curves, degrees
  std::optional<double> simplify;                            // tolerance, over d
  double smallest = 0;                                       // extent of curves, over d
  std::string layer, projection, unit, tag_field;            // of files that GDAL reads
  std::optional<SphereRequest> sphere;
  std::vector<std::string> inner;                           // groups of triangles, by name or tag
  std::vector<std::pair<std::int32_t, std::string>> names;  // of tags
  std::vector<Region> regions;
  std::optional<picture::ElementColour> colour;  // of elements in pictures
  std::optional<ViewRequest> view;               // of a sphere, in pictures
  std::string cut;                  // where pictures cut a body open; empty: through its middle
  std::optional<double> repair;     // its resolution, 0 for the default
  std::optional<double> resurface;  // likewise
  bool repair_if_needed = false;
  bool surfaces_only = false;  // nothing inside them
  bool bubbles = false;
  bool check = false;  // the results
  bool nodes_only = false;
  bool at_centres = false;  // nodes, of what they stand for
  bool in_walls = false;    // and that is a wall around the domain, with this many layers
  std::optional<int> wall_layers;
  bool volumes = false;                // of nodes
  std::optional<std::string> density;  // a formula
  std::vector<std::string> fields;     // NAME=FORMULA
  bool dry_run = false;
  bool quiet = false;
  bool progress = false;
};

// Parses the command line. If it only wants information (--help, --version, ...), that is the
// result; otherwise it is empty. Throws BadInput.
std::string parse_arguments(int argc, char** argv, Arguments& arguments);

}  // namespace pnpbs::tool
