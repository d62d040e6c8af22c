// SPDX-License-Identifier: BSD-3-Clause
#include "tool/arguments.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tool/argument_rules.hpp"
#include "tool/help.hpp"
#include "tool/library.hpp"
#include "tool/names.hpp"
#include "tool/numbers.hpp"

namespace pnpbs::tool {
namespace {

// Functions that parse the values of options. They throw BadInput if the text is not a valid value.

void take_angle(const std::string& option, const std::string& text, std::optional<double>& angle) {
  const auto numbers = numbers_between_commas(text);
  if (!numbers || numbers->size() != 1 || numbers->front() < 0 || numbers->front() > 180)
    refuse(option + ": expected degrees from 0 to 180, found '" + text + "'");
  angle = numbers->front();
}

void take_sphere(const std::string& text, Arguments& arguments) {
  // The point of Antarctica that is farthest from any sea.
  constexpr Point<2> deep_in_land{55, -82};
  const auto numbers = numbers_between_commas(text);
  const bool fits = numbers && (numbers->size() == 1 || numbers->size() == 3) &&
                    (*numbers)[0] > 0 && (numbers->size() == 1 || std::fabs((*numbers)[2]) <= 90);
  if (!fits)
    refuse(
        "--sphere: expected RADIUS or RADIUS,LON,LAT with a radius greater than 0 and degrees, "
        "found '" +
        text + "'");
  arguments.sphere = SphereRequest{(*numbers)[0], deep_in_land};
  if (numbers->size() == 3) arguments.sphere->outside = {(*numbers)[1], (*numbers)[2]};
}

void take_view(const std::string& text, Arguments& arguments) {
  if (text == "map") {
    arguments.view = ViewRequest{true, {}};
    return;
  }
  const auto numbers = numbers_between_commas(text);
  if (!numbers || numbers->size() != 2 || !(std::fabs((*numbers)[1]) <= 90))
    refuse("--view: expected LON,LAT in degrees, or map, found '" + text + "'");
  arguments.view = ViewRequest{false, {(*numbers)[0], (*numbers)[1]}};
}

void take_simplify(const std::string& text, Arguments& arguments) {
  const auto numbers = numbers_between_commas(text);
  const auto is_bad = [](double number) { return !(number >= 0); };
  if (!numbers || numbers->empty() || numbers->size() > 2 || std::ranges::any_of(*numbers, is_bad))
    refuse(
        "--simplify: expected TOLERANCE or TOLERANCE,EXTENT, both in d and not negative, found '" +
        text + "'");
  arguments.simplify = numbers->front();
  arguments.smallest = numbers->size() == 2 ? numbers->back() : 0;
}

void take_bound(const std::string& option, const std::string& text, std::optional<double>& bound) {
  const auto numbers = numbers_between_commas(text);
  if (!numbers || numbers->size() != 1 || !(numbers->front() > 0))
    refuse(option + ": expected a number greater than 0, found '" + text + "'");
  bound = numbers->front();
}

// Passes the text on as an option of the library. A number of nodes may have an exponent, as in
// 1e6.
void take_nodes(const std::string& text, Arguments& arguments) {
  std::optional<double> nodes;
  take_bound("--nodes", text, nodes);
  arguments.options.emplace_back("wanted_nodes", text);
}

void take_places(const std::string& text, Arguments& arguments) {
  arguments.in_walls = text == "walls";
  arguments.at_centres = arguments.in_walls || text == "centers" || text == "centres";
  if (!arguments.at_centres && text != "boundary")
    refuse("--nodes-at: unknown value '" + text + "' (known: boundary, centers, walls)");
}

// At least two layers are required: a single layer would be a surface, which bounds no body.
void take_wall_layers(const std::string& text, Arguments& arguments) {
  constexpr int most = 1000;  // larger than the support of any particle kernel
  int layers = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, layers);
  if (read.ec != std::errc() || read.ptr != end || layers < 2 || layers > most)
    refuse("--wall-layers: expected a number of layers from 2 to " + std::to_string(most) +
           ", found '" + text + "'");
  arguments.wall_layers = layers;
}

// Returns 0 if `text` is not an integer.
std::int32_t tag_in(std::string_view text) {
  std::int32_t tag = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, tag);
  return read.ec == std::errc() && read.ptr == end ? tag : 0;
}

void take_name(const std::string& text, Arguments& arguments) {
  const std::size_t equals = text.find('=');
  const std::string name = equals == std::string::npos ? "" : text.substr(equals + 1);
  const std::int32_t tag = tag_in(text.substr(0, equals));
  if (name.empty() || tag == 0)
    refuse("--name: expected TAG=NAME with a tag other than 0, found '" + text + "'");
  arguments.names.emplace_back(tag, name);
}

void take_region(const std::string& text, Arguments& arguments) {
  const std::size_t colon = text.find(':');
  const auto point = numbers_between_commas(text.substr(0, colon));
  const std::int32_t tag = colon == std::string::npos ? 0 : tag_in(text.substr(colon + 1));
  if (!point || point->size() < 2 || point->size() > 3 || tag == 0)
    refuse("--region: expected X,Y:TAG or X,Y,Z:TAG with a tag other than 0, found '" + text + "'");
  arguments.regions.push_back({*point, tag, text});
}

void take_repair(const std::vector<std::string>& text, Arguments& arguments) {
  arguments.repair_if_needed = text == std::vector<std::string>{"auto"};
  if (arguments.repair_if_needed) return;
  arguments.repair = 0;
  if (text.empty() || text[0].empty()) return;
  const auto numbers = numbers_between_commas(text[0]);
  if (!numbers || numbers->size() != 1 || !((*numbers)[0] > 0))
    refuse("--repair: expected a positive resolution or auto, found '" + text[0] + "'");
  arguments.repair = (*numbers)[0];
}

void take_fragment(const std::vector<std::string>& text, Arguments& arguments) {
  static const std::map<std::string, int> rules{{"", PNPBS_OVERLAP_LAST},
                                                {"last", PNPBS_OVERLAP_LAST},
                                                {"first", PNPBS_OVERLAP_FIRST},
                                                {"own", PNPBS_OVERLAP_OWN}};
  const auto rule = rules.find(text.empty() ? "" : text[0]);
  if (rule == rules.end())
    refuse("--fragment: expected last, first or own, found '" + text[0] + "'");
  arguments.fragment = rule->second;
}

void take_resurfacing(const std::vector<std::string>& text, Arguments& arguments) {
  const auto numbers = numbers_between_commas(text[0]);
  if (!numbers || numbers->size() != 1 || !((*numbers)[0] > 0))
    refuse("--resurface: expected a positive resolution, found '" + text[0] + "'");
  arguments.resurface = (*numbers)[0];
}

void take_colour(const std::string& name, Arguments& arguments) {
  const std::vector<std::string> names = picture::element_colour_names();
  const auto colour = picture::element_colour_called(name);
  if (!colour) {
    std::string known;
    for (const std::string& each : names) known += (known.empty() ? "" : ", ") + each;
    refuse("--color: unknown value '" + name + "'" + did_you_mean(name, names) +
           " (known: " + known + ")");
  }
  arguments.colour = *colour;
}

void take_settings(const std::vector<std::string>& settings, Arguments& arguments) {
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) {
      refuse("--set: expected KEY=VALUE, found '" + setting + "'");
    }
    arguments.options.emplace_back(setting.substr(0, equals), setting.substr(equals + 1));
  }
}

struct Questions {
  bool help = false, version = false, statistics = false;
};

// Adds an option that may be repeated, with one value per occurrence: "--output a --output b".
void add_repeatable(CLI::App& app, const std::string& name, std::vector<std::string>& values,
                    const std::string& help) {
  app.add_option(name, values, help)->allow_extra_args(false)->take_all();
}

void add_spacing_bounds(CLI::App& app, Arguments& arguments) {
  const std::string group = "What to fill";
  app.add_option_function<std::string>(
         "--min-spacing",
         [&arguments](const std::string& text) {
           take_bound("--min-spacing", text, arguments.min_spacing);
         },
         "with --spacing auto or --depth-rule: d is at least this")
      ->type_name("D")
      ->group(group);
  app.add_option_function<std::string>(
         "--max-spacing",
         [&arguments](const std::string& text) {
           take_bound("--max-spacing", text, arguments.max_spacing);
         },
         "with --spacing auto or --depth-rule: d is at most this")
      ->type_name("D")
      ->group(group);
  app.add_option_function<std::string>(
         "--nodes", [&arguments](const std::string& text) { take_nodes(text, arguments); },
         "requested number of nodes: d is multiplied by a factor to reach\n"
         "about this many; the same as --set wanted_nodes=NUMBER")
      ->type_name("NUMBER")
      ->group(group);
}

void add_input(CLI::App& app, Arguments& arguments) {
  const std::string group = "What to fill";
  app.add_option("--domain", arguments.domain,
                 "the domain: in the plane, a file in Triangle's .poly format (- for\n"
                 "standard input), or in a format that GDAL reads (.geojson, .shp,\n"
                 ".gpkg and others); in space, a closed surface in .stl, .off, .obj,\n"
                 ".ply, or TetGen's .poly or .smesh; in both, a mesh in Gmsh's .msh\n"
                 "format; or 'box(x0,y0,z0, x1,y1,z1)', 'ball(x,y,z, r)',\n"
                 "'cylinder(x0,y0,z0, x1,y1,z1, r)', or where a formula is negative\n"
                 "in a box, to the resolution h:\n"
                 "'levelset(x0,y0,z0, x1,y1,z1, h, f)'")
      ->type_name("FILE")
      ->group(group);
  app.add_option("--spacing", arguments.spacing,
                 "requested distance d between neighbouring nodes: a number, or a\n"
                 "formula in x and y (and z) such as '1 + 0.02*hypot(x,y)' or\n"
                 "'0.5 + 0.15*dist', with functions of the shape: dist, dist(TAG),\n"
                 "seglen, curvature(NODES), gap(NODES); or auto: derived from the\n"
                 "shape; or FILE or FILE:FIELD with values at points: a mesh (.vtu\n"
                 "or .msh), on which d is linear, or scattered points (.csv with\n"
                 "columns x, y and d)")
      ->type_name("EXPR")
      ->group(group);
  add_repeatable(app, "--spacing-grid", arguments.spacing_grids,
                 "d sampled on a grid, instead of --spacing; or values with the name\n"
                 "NAME in the formula of --spacing (grid without one), such as a\n"
                 "depth; an ESRI ASCII grid (.asc), or a format that GDAL reads\n"
                 "(.tif, .nc and others), projected like the domain; may be given\n"
                 "several times");
  app.get_option("--spacing-grid")->type_name("[NAME=]FILE[:VARIABLE]")->group(group);
  app.add_option_function<std::string>(
         "--depth-rule",
         [&arguments](const std::string& text) { arguments.depth_rule = depth_request_in(text); },
         "d by the depth on such a grid, in metres: 30 nodes per length of a\n"
         "tide wave, or wave=NODES and period=SECONDS; with slope=NODES also\n"
         "on slopes; with up for elevations; depths are at least 10,\n"
         "or least=DEPTH; metres=NUMBER is the unit of length in metres; in\n"
         "--spacing the name of this d is by_depth")
      ->type_name("[NAME=]FILE[:VARIABLE][,WORD]...")
      ->group(group);
  app.add_option("--spacing-hints", arguments.spacing_hints,
                 "points at which d is sampled as well, one per line of the file:\n"
                 "x,y or x,y,z, on a sphere lon,lat; one point in each place where\n"
                 "a formula has a small d that is much smaller than the distance\n"
                 "of the samples, which would miss it")
      ->type_name("FILE")
      ->group(group);
  app.add_option_function<std::string>(
         "--feature-angle",
         [&arguments](const std::string& text) {
           take_angle("--feature-angle", text, arguments.feature_angle);
         },
         "nodes follow a surface's edges where its normals turn by\nmore than this, and corners of "
         "curves in a .msh; default: 40\ndegrees")
      ->type_name("DEGREES")
      ->group(group);
}

void add_curves(CLI::App& app, Arguments& arguments) {
  const std::string group = "What to fill";
  app.add_option_function<std::string>(
         "--corner-angle",
         [&arguments](const std::string& text) {
           take_angle("--corner-angle", text, arguments.corner_angle);
         },
         "in the plane: nodes lie on vertices where the boundary turns by\n"
         "more than this, and between them at distances of d; default: 0,\n"
         "every vertex is a node")
      ->type_name("DEGREES")
      ->group(group);
  app.add_option_function<std::string>(
         "--snap",
         [&arguments](const std::string& text) {
           const auto numbers = numbers_between_commas(text);
           if (!numbers || numbers->size() != 1 || numbers->front() < 0)
             refuse("--snap: expected a length or 0, found '" + text + "'");
           arguments.snap = numbers->front();
         },
         "in the plane: move ends of curves, and fixed nodes, onto a curve\n"
         "or vertex that they miss by this length or less; default: 1e-7\n"
         "of the size of the domain; 0: move none; in space with --fragment:\n"
         "close gaps between surfaces, and overlaps, up to this length")
      ->type_name("LENGTH")
      ->group(group);
  app.add_option_function<std::string>(
         "--simplify", [&arguments](const std::string& text) { take_simplify(text, arguments); },
         "in the plane: remove vertices closer together than d, within\n"
         "TOLERANCE times d of the boundary, and islands and lakes with an\n"
         "extent less than EXTENT times d, if it is given")
      ->type_name("TOLERANCE[,EXTENT]")
      ->group(group);
}

void add_open_boundary(CLI::App& app, Arguments& arguments) {
  app.add_option("--open-boundary", arguments.open_boundary,
                 "in the plane or on a sphere: where this formula is greater than 0,\n"
                 "the boundary around the domain is open: it has a tag named open.\n"
                 "As for --spacing, with grids: 'depth > 50'")
      ->type_name("EXPR")
      ->group("What to fill");
}

// Adds the options of files that GDAL reads.
void add_geo(CLI::App& app, Arguments& arguments) {
  const std::string group = "What to fill";
  app.add_option_function<std::string>(
         "--sphere", [&arguments](const std::string& text) { take_sphere(text, arguments); },
         "on a sphere of this radius, in the unit of d, without a\n"
         "projection: the domain that the coasts in a GeoJSON file, a\n"
         "shapefile or the like bound, on the side away from a point outside\n"
         "of it, at a longitude and latitude; default: 55,-82, in Antarctica,\n"
         "for the seas. Without --domain, the whole sphere, on which nodes\n"
         "around that point are laid first. Formulas may contain lon and\n"
         "lat, and lengths are along the sphere")
      ->type_name("RADIUS[,LON,LAT]")
      ->group(group);
  app.add_option("--projection", arguments.projection,
                 "for GeoJSON, shapefiles and the like: the coordinate system of x\n"
                 "and y, as a code (EPSG:2180), a PROJ string or a .prj file; auto,\n"
                 "a local projection, the default for longitude and latitude; or\n"
                 "none")
      ->type_name("NAME")
      ->group(group);
  app.add_option("--unit", arguments.unit,
                 "unit of length of x, y and d, for the scale bar of pictures and\n"
                 "for --depth-rule; of that projection: m or km; default: its own")
      ->type_name("UNIT")
      ->group(group);
  app.add_option("--layer", arguments.layer, "the layer to read, for files with several")
      ->type_name("NAME")
      ->group(group);
  app.add_option("--tag-field", arguments.tag_field,
                 "the attribute that becomes the tag of curves and nodes")
      ->type_name("NAME")
      ->group(group);
  app.add_option("--region-field", arguments.region_field,
                 "the attribute of polygons that becomes the tag of the elements in\n"
                 "them")
      ->type_name("NAME")
      ->group(group);
}

void add_nodes_at(CLI::App& app, Arguments& arguments) {
  app.add_option_function<std::string>(
         "--nodes-at", [&arguments](const std::string& text) { take_places(text, arguments); },
         "boundary, the default: nodes lie on the boundary, and elements fill\n"
         "the domain; or centers: as particles, half a spacing inside, each\n"
         "of which stands for d^2 of the domain, or d^3 in space; they are\n"
         "written without elements and with --volumes; or walls: such\n"
         "particles in layers outside the boundary")
      ->type_name("PLACE")
      ->group("What to fill");
  app.add_option_function<std::string>(
         "--wall-layers",
         [&arguments](const std::string& text) { take_wall_layers(text, arguments); },
         "with --nodes-at walls: the number of layers; default: 3")
      ->type_name("NUMBER")
      ->group("What to fill");
}

// Texts that are converted to values after all arguments have been parsed.
struct Texts {
  std::vector<std::string> settings, names, regions;
};

void add_groups(CLI::App& app, Arguments& arguments, Texts& texts) {
  add_repeatable(app, "--inner", arguments.inner,
                 "in space: nodes follow the triangles of this group, which lie\ninside and bound "
                 "nothing; may be given several times");
  app.get_option("--inner")->type_name("NAME|TAG")->group("What to fill");
  add_repeatable(
      app, "--name", texts.names,
      "name of a tag of the boundary, for files with named groups\n(.msh, .msh2) or open "
      "boundaries (.gr3); may be given several\ntimes");
  app.get_option("--name")->type_name("TAG=NAME")->group("What to fill");
  add_repeatable(app, "--region", texts.regions,
                 "tag of the elements in the region around this point, up to the\n"
                 "next curves or surfaces; may be given several times");
  app.get_option("--region")->type_name("X,Y[,Z]:TAG")->group("What to fill");
}

void add_repair(CLI::App& app, Arguments& arguments) {
  app.add_option_function<std::vector<std::string>>(
         "--repair",
         [&arguments](const std::vector<std::string>& text) { take_repair(text, arguments); },
         "in space: the body that the triangles enclose, even if they are\n"
         "open, crossing or inconsistently oriented, to this resolution;\n"
         "default: 1/64 of the longest side; a sound body stays as it is;\n"
         "auto: only if the body is refused otherwise, or, with d as the\n"
         "resolution, if its boundary is torn at the end of the run")
      ->expected(0, 1)
      ->type_name("[RESOLUTION|auto]")
      ->group("What to fill");
  app.add_option_function<std::vector<std::string>>(
         "--resurface",
         [&arguments](const std::vector<std::string>& text) { take_resurfacing(text, arguments); },
         "in space: as --repair, but even if the body is sound, to remove\n"
         "what is finer than this resolution")
      ->expected(1)
      ->type_name("RESOLUTION")
      ->group("What to fill");
}

void add_fragment(CLI::App& app, Arguments& arguments) {
  app.add_option_function<std::vector<std::string>>(
         "--fragment",
         [&arguments](const std::vector<std::string>& text) { take_fragment(text, arguments); },
         "split curves, or surfaces in space, where they meet: the closed\n"
         "groups of the file, and what others divide, become regions of one\n"
         "domain; where groups overlap, the elements have the tag of the\n"
         "last one (or the first), or own: a tag for each combination")
      ->expected(0, 1)
      ->type_name("[last|first|own]")
      ->group("What to fill");
}

void add_surfaces_only(CLI::App& app, Arguments& arguments) {
  app.add_flag("--surfaces-only", arguments.surfaces_only,
               "in space: place nodes and triangles only on the surfaces, which\n"
               "may be open")
      ->group("What to fill");
}

void add_output(CLI::App& app, Arguments& arguments) {
  const std::string group = "What to write";
  add_repeatable(app, "-o,--output", arguments.outputs,
                 "file to write; the extension selects the format (below); may be\n"
                 "given several times; - for standard output");
  app.get_option("--output")->type_name("FILE")->group(group);
  app.add_option("--format", arguments.format, "format of standard output and of other extensions")
      ->type_name("NAME")
      ->group(group);
  app.add_option("--report", arguments.report, "statistics as JSON, - for standard output")
      ->type_name("FILE")
      ->group(group);
  app.add_flag("--nodes-only", arguments.nodes_only,
               "no triangles or tetrahedra in formats where they are optional\n"
               "(.vtu, .pvtu, .vtkhdf, .xdmf, .msh, .msh2)")
      ->group(group);
  app.add_option("--order", arguments.order,
                 "order of triangles and tetrahedra in .vtu, .vtkhdf, .msh and .msh2:\n"
                 "1, or 2 with mid nodes, which follow curves and surfaces")
      ->type_name("N")
      ->check(CLI::Range(1, 2))
      ->group(group);
  add_repeatable(app, "--crack", arguments.cracks,
                 "doubles the nodes on the inner curve or surface of this group in\n"
                 ".vtu, .vtkhdf, .msh and .msh2, except at its tips; may be given\n"
                 "several times");
  app.get_option("--crack")->type_name("NAME|TAG")->group(group);
  app.add_flag("--volumes", arguments.volumes,
               "the volume of each node's Voronoi cell (areas in the plane and on\n"
               "surfaces), as the field volume in .vtu, .pvtu, .vtkhdf, .xdmf,\n"
               ".msh, .msh2, .csv and .ugrid; figures in the report and the summary")
      ->group(group);
  app.add_option("--density", arguments.density,
                 "density of the matter that nodes stand for, a number or a formula\n"
                 "in x and y (and z): adds the fields density and mass, density\n"
                 "times volume, and implies --volumes")
      ->type_name("EXPR")
      ->group(group);
  add_repeatable(app, "--field", arguments.fields,
                 "field of the nodes in the files that have that of --volumes, and, with\n"
                 "the name depth, in .gr3 and .2dm: values of a formula with the names\n"
                 "of --spacing and --spacing-grid; may be given several times");
  app.get_option("--field")->type_name("NAME=EXPR")->group(group);
  app.add_flag("--bubbles", arguments.bubbles, "draw the bubbles in pictures")->group(group);
  app.add_option_function<std::string>(
         "--color", [&arguments](const std::string& name) { take_colour(name, arguments); },
         "colour the triangles in pictures by quality, edge (mean length\n"
         "over d) or spacing (d), or none, the default; for bodies the cut\n"
         "tetrahedra, with quality as default")
      ->type_name("BY")
      ->group(group);
  app.add_option_function<std::string>(
         "--view", [&arguments](const std::string& text) { take_view(text, arguments); },
         "how pictures show a sphere: LON,LAT, from above this longitude and\n"
         "latitude, or map, all of it with longitude and latitude as axes\n"
         "(plate carree); default: from opposite to the point of --sphere")
      ->type_name("LON,LAT|map")
      ->group(group);
  app.add_option("--cut", arguments.cut,
                 "the plane where pictures cut a body open: x=NUMBER, y=NUMBER,\n"
                 "z=NUMBER, or A,B,C,D for A x + B y + C z = D; default: through the\n"
                 "middle, perpendicular to the shortest extent")
      ->type_name("PLANE")
      ->group(group);
}

void add_checkpoints(CLI::App& app, Arguments& arguments) {
  const std::string group = "How to be interrupted";
  app.add_option("--checkpoint", arguments.checkpoint,
                 "write a file from which --restart continues, at the end and when\n"
                 "the run is stopped (Ctrl-C); .vtkhdf, which ParaView opens")
      ->type_name("FILE")
      ->group(group);
  app.add_option_function<std::string>(
         "--checkpoint-every",
         [&arguments](const std::string& text) {
           arguments.checkpoint_interval = checkpoint_interval_in(text);
         },
         "and at this interval: a number of steps, or a time such as 90s,\n"
         "30min or 2h")
      ->type_name("STEPS|TIME")
      ->group(group);
  app.add_option("--restart", arguments.restart,
                 "continue from a checkpoint, with the same domain, spacing and\n"
                 "options, on any number of ranks, to the same nodes bit for bit;\n"
                 "options that --set gives another value change from there on:\n"
                 "--set steps=600 for more steps")
      ->type_name("FILE")
      ->group(group);
}

void add_general(CLI::App& app, Arguments& arguments, Questions& questions) {
  const std::string group = "Others";
  app.set_help_flag();
  app.add_flag("--dry-run", arguments.dry_run,
               "report the approximate number of nodes, memory and time; place and\n"
               "write nothing")
      ->group(group);
  app.add_flag("-q,--quiet", arguments.quiet, "print nothing but errors")->group(group);
  app.add_flag("--progress", arguments.progress,
               "show a progress bar even if standard error is not a terminal, as\n"
               "under mpirun")
      ->group(group);
  app.add_flag("--check", arguments.check,
               "check the results before they are written: lists, triangles or\n"
               "tetrahedra, area or volume; an error if any check fails")
      ->group(group);
  app.add_flag("-h,--help", questions.help, "this text")->group(group);
  app.add_flag("--version", questions.version, "version and build configuration")->group(group);
  app.add_flag("--list-statistics", questions.statistics, "the keys of the report")->group(group);
}

// Adds short forms of --set key=value for those of these options that the library has.
void add_library_options(CLI::App& app, Arguments& arguments, Texts& texts) {
  const std::string group = "How to do it";
  add_repeatable(app, "--set", texts.settings,
                 "set an option of the library (below); may be repeated");
  app.get_option("--set")->type_name("KEY=VALUE")->group(group);
  for (const LibraryOption& option : library_options()) {
    if (option.name != "steps" && option.name != "threads" && option.name != "growth_limit")
      continue;
    std::string flag = "--" + option.name;
    std::ranges::replace(flag, '_', '-');
    app.add_option_function<std::string>(
           flag,
           [&arguments, key = option.name](const std::string& value) {
             arguments.options.emplace_back(key, value);
           },
           "the same as --set " + option.name + "=VALUE")
        ->type_name("VALUE")
        ->group(group);
  }
}

void refuse_unknown(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  for (const std::string& word : app.remaining()) {
    if (word == "--") continue;
    if (!word.starts_with('-')) refuse("unexpected argument '" + word + "'");
    const std::string name = word.substr(0, word.find('='));
    refuse("unknown option " + name + did_you_mean(name, names));
  }
}

// Removes all but one of several empty lines between groups.
std::string compact(std::string text) {
  for (std::size_t at; (at = text.find("\n\n\n")) != std::string::npos;) text.erase(at, 1);
  return text;
}

}  // namespace

std::string parse_arguments(int argc, char** argv, Arguments& arguments) {
  CLI::App app(
      "Places nodes in a domain, in the plane or in space, with distances that follow a spacing "
      "function.",
      "pnpbs");
  Questions questions;
  Texts texts;
  app.allow_extras();
  app.get_formatter()->column_width(28);
  add_input(app, arguments);
  add_spacing_bounds(app, arguments);
  add_curves(app, arguments);
  add_open_boundary(app, arguments);
  add_geo(app, arguments);
  add_repair(app, arguments);
  add_fragment(app, arguments);
  add_surfaces_only(app, arguments);
  add_nodes_at(app, arguments);
  add_groups(app, arguments, texts);
  add_output(app, arguments);
  add_library_options(app, arguments, texts);
  add_checkpoints(app, arguments);
  add_general(app, arguments, questions);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    refuse(error.what());
  }
  refuse_unknown(app);
  std::string answer;
  if (questions.help) answer += compact(app.help()) + help_tables();
  if (questions.version) answer += version_text();
  if (questions.statistics) answer += statistics_text();
  if (!answer.empty()) return answer;
  take_settings(texts.settings, arguments);
  for (const std::string& name : texts.names) take_name(name, arguments);
  for (const std::string& region : texts.regions) take_region(region, arguments);
  request_data_for_formats(arguments);
  require_arguments_that_fit(arguments);
  return "";
}

}  // namespace pnpbs::tool
