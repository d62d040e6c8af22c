// SPDX-License-Identifier: BSD-3-Clause
#include "tool/report.hpp"

#include <nlohmann/json.hpp>

namespace pnpbs::tool {
namespace {

using Json = nlohmann::ordered_json;

struct AsJson {
  Json operator()(std::monostate) const { return nullptr; }
  Json operator()(std::int64_t value) const { return value; }
  Json operator()(double value) const { return value; }  // null if not finite
  Json operator()(const std::string& value) const { return value; }
};

// Inserts "seconds.total" as an entry of the object "seconds". A name that is also the beginning of
// other names keeps its dots.
void insert(Json& object, const std::string& name, const Json& value) {
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos) {
    object[name] = value;
    return;
  }
  Json& inner = object[name.substr(0, dot)];
  if (inner.is_null() || inner.is_object()) {
    insert(inner, name.substr(dot + 1), value);
  } else {
    object[name] = value;
  }
}

Json options_of(const Arguments& arguments) {
  Json options = Json::object();
  for (const auto& [key, value] : arguments.options) options[key] = value;
  return options;
}

Json edge_bands_of(const Statistics& statistics) {
  Json bands = Json::array();
  for (const EdgeBand& band : statistics.edge_bands()) {
    bands.push_back({{"from", band.from},
                     {"to", band.to},
                     {"edges", band.edges},
                     {"mean", band.mean},
                     {"deviation", band.deviation}});
  }
  return bands;
}

// The figures have the same names as the statistics of all cells or edges.
Json cell_bands_of(const Statistics& statistics) {
  Json bands = Json::array();
  for (const CellBand& band : statistics.cell_bands()) {
    Json entry = {{"from", band.from}, {"to", band.to}, {"cells", band.edge_ratio.number}};
    const auto add = [&](const std::string& worst, const std::string& what,
                         const CellFigure& figure) {
      entry["mean_" + what] = figure.number > 0 ? Json(figure.mean) : Json();
      entry[worst + "_" + what] = figure.number > 0 ? Json(figure.worst) : Json();
    };
    add("min", "edge_ratio", band.edge_ratio);
    entry["edges"] = band.dual_offset.number;
    add("min", "area_ratio", band.area_ratio);
    add("max", "dual_offset", band.dual_offset);
    bands.push_back(std::move(entry));
  }
  return bands;
}

// Adds how the geographic file was read.
void describe(const GeoFile& geo, const Arguments& arguments, Json& report) {
  if (!arguments.layer.empty()) report["layer"] = arguments.layer;
  if (!arguments.tag_field.empty()) report["tag_field"] = arguments.tag_field;
  if (!arguments.region_field.empty()) report["region_field"] = arguments.region_field;
  const GeoFile::Projection projection = geo.projection();
  if (projection.name.empty()) return;
  report["projection"] = {{"name", projection.name},
                          {"unit", projection.unit},
                          {"scale", {projection.least_scale, projection.greatest_scale}},
                          {"proj", projection.proj},
                          {"wkt", projection.wkt}};
}

Json groups_of(const std::vector<GroupName>& groups) {
  Json list = Json::array();
  for (const GroupName& group : groups)
    list.push_back({{"dimension", group.dimension}, {"tag", group.tag}, {"name", group.name}});
  return list;
}

Json figures_of(const std::vector<RegionRow>& regions, bool have_volumes) {
  Json list = Json::array();
  for (const RegionRow& region : regions) {
    Json entry = {{"tag", region.tag}};
    if (!region.name.empty()) entry["name"] = region.name;
    entry["nodes"] = region.nodes;
    entry["elements"] = region.elements;
    entry[have_volumes ? "volume" : "area"] = region.measure;
    list.push_back(std::move(entry));
  }
  return list;
}

Json figures_of(const VolumeFigures& volumes) {
  return {{"total", volumes.total},
          {"ratio", {{"mean", volumes.mean}, {"min", volumes.min}, {"max", volumes.max}}}};
}

Json figures_of(const ParticleFigures& particles) {
  return {{"count", particles.count},
          {"outermost", particles.outermost},
          {"left_out", particles.left_out},
          {"moved", particles.moved},
          {"closest", particles.closest}};  // null if not finite
}

}  // namespace

std::string report_text(const Arguments& arguments, const GeoFile* geo,
                        const Statistics& statistics, const std::optional<VolumeFigures>& volumes,
                        const std::optional<ParticleFigures>& particles,
                        const std::vector<GroupName>& groups, const std::vector<RegionRow>& regions,
                        bool regions_have_volumes, const std::vector<std::string>& warnings) {
  Json report;
  report["domain"] = arguments.domain;
  if (!arguments.unit.empty()) report["unit"] = arguments.unit;
  if (geo) describe(*geo, arguments, report);
  if (arguments.sphere)
    report["sphere"] = {{"radius", arguments.sphere->radius},
                        {"outside", arguments.sphere->outside}};
  if (arguments.feature_angle) report["feature_angle"] = *arguments.feature_angle;
  if (arguments.repair) report["repair"] = *arguments.repair;
  if (arguments.repair_if_needed) report["repair"] = "auto";
  if (arguments.resurface) report["resurface"] = *arguments.resurface;
  if (arguments.fragment)
    report["fragment"] =
        std::array{"last", "first", "own"}[static_cast<std::size_t>(*arguments.fragment)];
  if (arguments.surfaces_only) report["surfaces_only"] = true;
  if (!arguments.inner.empty()) report["inner"] = arguments.inner;
  for (const Region& region : arguments.regions) report["regions"].push_back(region.text);
  if (!groups.empty()) report["groups"] = groups_of(groups);
  if (arguments.density) report["density"] = *arguments.density;
  if (!arguments.fields.empty()) report["fields"] = arguments.fields;
  if (!arguments.spacing.empty()) report["spacing"] = arguments.spacing;
  if (arguments.spacing_grids.size() == 1)
    report["spacing_grid"] = arguments.spacing_grids[0];
  else if (!arguments.spacing_grids.empty())
    report["spacing_grid"] = arguments.spacing_grids;
  if (arguments.depth_rule) report["depth_rule"] = arguments.depth_rule->text;
  report["options"] = options_of(arguments);
  for (const auto& [name, value] : statistics.all())
    insert(report, name, std::visit(AsJson(), value));
  report["edge"]["bands"] = edge_bands_of(statistics);
  if (!statistics.cell_bands().empty()) report["cell"]["bands"] = cell_bands_of(statistics);
  if (!regions.empty()) report["by_region"] = figures_of(regions, regions_have_volumes);
  if (volumes) report["volumes"] = figures_of(*volumes);
  if (volumes && volumes->mass) report["mass"] = *volumes->mass;
  if (particles) report["particles"] = figures_of(*particles);
  report["warnings"] = warnings;
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace pnpbs::tool
