// SPDX-License-Identifier: BSD-3-Clause
// The arguments of the command line as values.
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

// A tag for the region around a point, which has as many coordinates as the domain.
struct Region {
  std::vector<double> point;
  std::int32_t tag;
  std::string text;  // as given on the command line
};

// A sphere. The domain is the part of it that coasts bound.
struct SphereRequest {
  double radius;
  Point<2> outside;  // longitude and latitude of a point outside the domain
};

struct ViewRequest {
  bool as_map;
  Point<2> from;  // longitude and latitude
};

struct Arguments {
  std::string domain;                      // a file, "-", or a primitive such as "ball(0,0,0, 1)"
  std::string spacing;                     // a formula; may be empty if there is a grid
  std::vector<std::string> spacing_grids;  // FILE or NAME=FILE
  std::string spacing_hints;               // a file, or empty
  std::optional<DepthRequest> depth_rule;
  std::optional<double> min_spacing, max_spacing;  // bounds of a d that is not given by a formula
  std::vector<std::string> outputs;
  std::string format;               // for standard output and unknown extensions
  std::string report;               // a file, "-", or empty
  std::string checkpoint, restart;  // files, or empty
  CheckpointInterval checkpoint_interval;
  std::vector<std::pair<std::string, std::string>> options;  // key and value for the library
  std::optional<double> feature_angle;                       // of surfaces, in degrees
  std::optional<double> corner_angle;                        // of curves, in degrees
  std::optional<double> snap;  // distance over which loose points are moved onto curves
  // Tolerance of the simplification, over d.
  std::optional<double> simplify;
  // Extent below which curves are left out, over d.
  double smallest = 0;
  std::string layer, projection, unit, tag_field, region_field;  // for files that GDAL reads
  std::string open_boundary;  // formula, greater than 0 where the boundary is open
  std::optional<SphereRequest> sphere;
  std::vector<std::string> inner;                           // groups of triangles, by name or tag
  std::vector<std::pair<std::int32_t, std::string>> names;  // tags and their names
  std::vector<Region> regions;
  std::optional<picture::ElementColour> colour;  // of elements in pictures
  std::optional<ViewRequest> view;               // of a sphere in pictures
  std::string cut;                  // plane that cuts bodies in pictures; empty: through the middle
  std::optional<double> repair;     // resolution of the repair, 0 for the default
  std::optional<double> resurface;  // resolution of the resurfacing, 0 for the default
  bool repair_if_needed = false;
  std::optional<std::int32_t> fragment;  // the rule for overlaps, PNPBS_OVERLAP_LAST, ...
  bool surfaces_only = false;            // no nodes inside the surfaces
  bool bubbles = false;
  bool check = false;  // whether the results are checked
  bool nodes_only = false;
  int order = 1;                    // of the elements in files
  std::vector<std::string> cracks;  // curves or surfaces, by name or tag
  bool at_centres = false;          // nodes lie at the centres of the matter they represent
  bool in_walls = false;            // as at_centres, but the matter is a wall around the domain
  std::optional<int> wall_layers;
  bool volumes = false;                // whether the volumes of nodes are computed
  std::optional<std::string> density;  // a formula
  std::vector<std::string> fields;     // NAME=FORMULA
  bool dry_run = false;
  bool quiet = false;
  bool progress = false;
};

// Parses the command line. Returns the text to print if only information is requested (--help,
// --version, ...), and an empty string otherwise. Throws BadInput.
std::string parse_arguments(int argc, char** argv, Arguments& arguments);

}  // namespace pnpbs::tool
