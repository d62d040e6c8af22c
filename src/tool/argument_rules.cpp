// SPDX-License-Identifier: BSD-3-Clause
#include "tool/argument_rules.hpp"

#include <algorithm>

#include "base/extension.hpp"
#include "tool/cut.hpp"
#include "tool/exit.hpp"
#include "tool/file_format.hpp"
#include "tool/spacing.hpp"

namespace pnpbs::tool {

void refuse(const std::string& what) { throw BadInput(what + "\nTry 'pnpbs --help'."); }

namespace {

void require_centres_that_fit(const Arguments& arguments, bool multiplied) {
  if (arguments.wall_layers && !arguments.in_walls) refuse("--wall-layers needs --nodes-at walls");
  if (!arguments.at_centres) return;
  const std::string option = arguments.in_walls ? "--nodes-at walls" : "--nodes-at centers";
  if (arguments.spacing == "auto" || spacing_file(arguments.spacing))
    refuse(option + " needs d as a formula or on a grid: use --spacing or --spacing-grid");
  if (multiplied)
    refuse(option +
           " takes d as given, so --nodes cannot scale it: the number of particles is the measure "
           "of the " +
           (arguments.in_walls ? "wall" : "domain") + " over d^2, or d^3 in space");
  if (arguments.order == 2)
    refuse(option + " and --order 2 exclude each other: particles have no elements");
  if (!arguments.cracks.empty())
    refuse(option + " and --crack exclude each other: particles have no elements");
  if (arguments.surfaces_only)
    refuse(option + " is for bodies, and with --surfaces-only nothing is inside");
  if (arguments.repair_if_needed)
    refuse(option + " and --repair auto exclude each other: give the resolution of --repair");
  if (!arguments.regions.empty())
    refuse(
        option +
        " and --region exclude each other: regions are tags of elements, and particles have none");
}

void require_depth_rule_that_fits(const Arguments& arguments) {
  const DepthRequest& request = *arguments.depth_rule;
  const std::string option = DepthRequest::option;
  if (arguments.spacing == "auto" || spacing_file(arguments.spacing))
    refuse(option + " and a --spacing that is no formula exclude each other");
  if (request.rule.wave == 0 && arguments.spacing.empty() && !arguments.max_spacing)
    refuse(option + ": with wave=0 nothing bounds d where the bottom is flat: give --max-spacing");
  if (arguments.sphere) metres_per_unit(request, arguments.unit);
}

void require_what_spheres_have(const Arguments& arguments) {
  if (!arguments.sphere) {
    if (arguments.view) refuse("--view is for pictures of a sphere: it needs --sphere");
    return;
  }
  const auto refuse_if = [](bool is_set, const std::string& option) {
    if (is_set) refuse("--sphere and " + option + " exclude each other");
  };
  refuse_if(!arguments.projection.empty(), "--projection");
  refuse_if(arguments.surfaces_only, "--surfaces-only");
  refuse_if(arguments.at_centres, "--nodes-at");
  refuse_if(arguments.repair || arguments.repair_if_needed, "--repair");
  refuse_if(arguments.resurface.has_value(), "--resurface");
  refuse_if(arguments.fragment.has_value(), "--fragment");
  refuse_if(arguments.feature_angle.has_value(), "--feature-angle");
  refuse_if(!arguments.inner.empty(), "--inner");
  refuse_if(!arguments.cut.empty(), "--cut");
  refuse_if(arguments.bubbles, "--bubbles");
}

}  // namespace

void request_data_for_formats(Arguments& arguments) {
  for (const std::string& path : arguments.outputs) {
    const FileFormat* format = path == "-" ? nullptr : format_by_extension(path);
    if (!format) format = format_by_name(arguments.format);
    const std::string name = format ? format->name : "";
    if (name != "peridigm" && name != "lammps" && name != "hdf5") continue;
    if (arguments.surfaces_only)
      refuse("a ." + name + " file is for bodies, and with --surfaces-only nothing is inside");
    if (name != "peridigm" && !arguments.density)
      refuse("a ." + name + " file needs the density of particles: give --density");
    arguments.volumes = true;
  }
}

void require_arguments_that_fit(const Arguments& arguments) {
  if (arguments.domain.empty() && !arguments.sphere)
    refuse("--domain is missing (without it, --sphere RADIUS is the whole sphere)");
  const std::size_t grids = arguments.spacing_grids.size();
  const bool by_depth = arguments.depth_rule.has_value();
  if (arguments.spacing.empty() && grids == 0 && !by_depth)
    refuse("--spacing or --spacing-grid is missing");
  if (arguments.spacing.empty() && grids + (by_depth ? 1 : 0) > 1)
    refuse(by_depth
               ? "--depth-rule and --spacing-grid need a formula that combines them: give --spacing"
               : "several --spacing-grid need a formula that combines them: give --spacing");
  if (by_depth) require_depth_rule_that_fits(arguments);
  if (grids > 0 && arguments.fields.empty() &&
      (arguments.spacing == "auto" || spacing_file(arguments.spacing)))
    refuse("--spacing-grid and a --spacing that is no formula exclude each other");
  const bool has_formula = arguments.spacing != "auto" && !(by_depth && arguments.spacing.empty());
  if (has_formula && (arguments.min_spacing || arguments.max_spacing)) {
    refuse(
        "--min-spacing and --max-spacing are for --spacing auto and --depth-rule; in a formula, "
        "use min(...) and max(...)");
  }
  if (arguments.min_spacing && arguments.max_spacing &&
      *arguments.min_spacing > *arguments.max_spacing) {
    refuse("--min-spacing is above --max-spacing");
  }
  const bool multiplied =
      std::any_of(arguments.options.begin(), arguments.options.end(),
                  [](const auto& option) { return option.first == "wanted_nodes"; });
  if (multiplied && (arguments.min_spacing || arguments.max_spacing))
    refuse(
        "--nodes multiplies d, so that --min-spacing and --max-spacing would not hold: give the "
        "number or the bounds");
  if (multiplied && arguments.simplify)
    refuse(
        "--simplify uses d as given, and --nodes multiplies it: find d by --nodes with "
        "--dry-run, and give it to --spacing");
  require_centres_that_fit(arguments, multiplied);
  require_what_spheres_have(arguments);
  const auto colour = arguments.colour.value_or(picture::ElementColour::none);
  if (arguments.nodes_only && arguments.order == 2)
    refuse("--nodes-only and --order 2 exclude each other");
  if (!arguments.cracks.empty() && arguments.nodes_only)
    refuse("--crack and --nodes-only exclude each other: cracks double the nodes of elements");
  if (!arguments.cracks.empty() && arguments.order == 2)
    refuse("--crack and --order 2 exclude each other: elements with cracks are of first order");
  if (!arguments.cracks.empty() && arguments.surfaces_only)
    refuse("--crack and --surfaces-only exclude each other: surfaces alone have no cracks");
  if (arguments.bubbles && colour != picture::ElementColour::none) {
    refuse("--bubbles and --color exclude each other");
  }
  if (arguments.simplify && arguments.spacing == "auto")
    refuse(
        "--simplify needs d as a formula or from a file: auto follows every vertex of the "
        "boundary");
  const CheckpointInterval& interval = arguments.checkpoint_interval;
  if (arguments.checkpoint.empty() && (interval.steps > 0 || interval.time.count() > 0))
    refuse("--checkpoint-every needs --checkpoint");
  if (arguments.repair_if_needed && !(arguments.checkpoint.empty() && arguments.restart.empty()))
    refuse(
        "--repair auto may choose another body in every run, and a checkpoint belongs to one body: "
        "give the resolution of --repair");
  if (arguments.resurface && (arguments.repair || arguments.repair_if_needed))
    refuse("--resurface and --repair exclude each other");
  if (arguments.fragment && (arguments.repair || arguments.repair_if_needed || arguments.resurface))
    refuse("--fragment excludes --repair and --resurface");
  if (arguments.fragment && arguments.surfaces_only)
    refuse("--fragment and --surfaces-only exclude each other");
  if (!arguments.cut.empty()) cut_plane_in(arguments.cut);
}

void refuse_other_dimension(const Arguments& arguments, int dimension) {
  if (arguments.sphere) {
    for (const Region& region : arguments.regions)
      if (region.point.size() != 2)
        refuse("--region: expected LON,LAT:TAG on a sphere, found '" + region.text + "'");
    return;
  }
  const std::string plane = ", and this domain is in the plane";
  const bool is_msh = extension_of(arguments.domain) == "msh";
  if (dimension == 2 && arguments.feature_angle && !is_msh)
    refuse("--feature-angle is for bodies and .msh files" + plane);
  if (dimension == 2 && !arguments.inner.empty())
    refuse("--inner is for surfaces in space" + plane);
  if (dimension == 2 && (arguments.repair || arguments.repair_if_needed))
    refuse("--repair is for surfaces in space" + plane);
  if (dimension == 2 && arguments.resurface) refuse("--resurface is for surfaces in space" + plane);
  if (dimension == 2 && arguments.surfaces_only)
    refuse("--surfaces-only is for surfaces in space" + plane);
  if (dimension == 2 && !arguments.cut.empty()) refuse("--cut is for bodies" + plane);
  if (dimension == 3 && arguments.corner_angle)
    refuse(
        "--corner-angle is for domains in the plane, and this one is a body: use --feature-angle");
  if (dimension == 3 && arguments.snap && !arguments.fragment)
    refuse("--snap is for domains in the plane and, with --fragment, for bodies");
  if (arguments.sphere && arguments.snap)
    refuse("--snap is for domains in the plane, and this one is on a sphere");
  if (dimension == 3 && !arguments.sphere && !arguments.open_boundary.empty())
    refuse("--open-boundary is for domains in the plane and on a sphere, and this one is a body");
  if (dimension == 3 && arguments.simplify)
    refuse("--simplify is for domains in the plane, and this one is a body");
  if (arguments.surfaces_only && !arguments.cut.empty())
    refuse("--cut is for bodies, and with --surfaces-only nothing is inside");
  for (const Region& region : arguments.regions)
    if (std::ssize(region.point) != dimension)
      refuse(std::string("--region: expected ") + (dimension == 2 ? "X,Y:TAG" : "X,Y,Z:TAG") +
             " for this domain, found '" + region.text + "'");
  if (arguments.surfaces_only && !arguments.regions.empty())
    refuse("--region is for the inside of bodies, and with --surfaces-only nothing is inside");
  using picture::ElementColour;
  const bool coloured = arguments.colour.value_or(ElementColour::none) != ElementColour::none;
  if (arguments.surfaces_only && coloured)
    refuse("--color is for the tetrahedra of bodies, and with --surfaces-only there are none");
  if (dimension == 3 && arguments.bubbles)
    refuse("--bubbles is for domains in the plane, and this one is a body");
}

}  // namespace pnpbs::tool
