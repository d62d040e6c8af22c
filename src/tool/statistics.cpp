// SPDX-License-Identifier: BSD-3-Clause
#include "tool/statistics.hpp"

namespace pnpbs::tool {
namespace {

StatisticValue read(pnpbs_placement placement, const LibraryStatistic& statistic) {
  const char* name = statistic.name.c_str();
  std::int64_t integer = 0;
  double real = 0;
  const char* text = "";
  if (statistic.type == "integer" && pnpbs_placement_get_int64(placement, name, &integer) >= 0) {
    return integer;
  }
  if (statistic.type == "real" && pnpbs_placement_get_double(placement, name, &real) >= 0) {
    return real;
  }
  if (statistic.type == "string" && pnpbs_placement_get_string(placement, name, &text) >= 0) {
    return std::string(text);
  }
  return {};
}

constexpr std::size_t kMaxBands = 8;

// Returns no bands if the library has no value.
std::vector<EdgeBand> read_edge_bands(pnpbs_placement placement) {
  std::int64_t count = 0, edges[kMaxBands];
  double from[kMaxBands], to[kMaxBands], mean[kMaxBands], deviation[kMaxBands];
  if (pnpbs_placement_get_edge_bands(placement, kMaxBands, &count, from, to, edges, mean,
                                     deviation) < 0)
    return {};
  std::vector<EdgeBand> bands;
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
    bands.push_back({from[k], to[k], edges[k], mean[k], deviation[k]});
  return bands;
}

std::vector<CellBand> read_cell_bands(pnpbs_placement placement) {
  constexpr std::pair<const char*, CellFigure CellBand::*> kMeasures[] = {
      {"edge_ratio", &CellBand::edge_ratio},
      {"area_ratio", &CellBand::area_ratio},
      {"dual_offset", &CellBand::dual_offset}};
  std::int64_t count = 0, number[kMaxBands];
  double from[kMaxBands], to[kMaxBands], mean[kMaxBands], worst[kMaxBands];
  std::vector<CellBand> bands;
  for (const auto& [name, figure] : kMeasures) {
    if (pnpbs_placement_get_cell_bands(placement, name, kMaxBands, &count, from, to, number, mean,
                                       worst) < 0)
      return {};
    bands.resize(static_cast<std::size_t>(count));
    for (std::size_t k = 0; k < bands.size(); ++k) {
      bands[k].from = from[k];
      bands[k].to = to[k];
      bands[k].*figure = {number[k], mean[k], worst[k]};
    }
  }
  return bands;
}

}  // namespace

std::vector<RegionRow> region_rows(pnpbs_placement placement, pnpbs_domain domain, int dimension,
                                   pnpbs_context context) {
  if (pnpbs_domain_regions_at(domain, 0, nullptr, 1, nullptr) < 0) return {};
  std::int64_t count = 0;
  check(pnpbs_placement_get_regions(placement, 0, &count, nullptr, nullptr, nullptr, nullptr),
        context);
  const auto n = static_cast<std::size_t>(count);
  std::vector<std::int32_t> tags(n);
  std::vector<std::int64_t> nodes(n), elements(n);
  std::vector<double> measures(n);
  check(pnpbs_placement_get_regions(placement, count, &count, tags.data(), nodes.data(),
                                    elements.data(), measures.data()),
        context);
  const std::vector<GroupName> groups = group_names(domain, context);
  std::vector<RegionRow> rows;
  for (std::size_t k = 0; k < n; ++k) {
    rows.push_back({tags[k], "", nodes[k], elements[k], measures[k]});
    for (const GroupName& group : groups)
      if (group.dimension == dimension && group.tag == tags[k]) rows.back().name = group.name;
  }
  return rows;
}

Statistics::Statistics(pnpbs_placement placement) {
  for (const LibraryStatistic& statistic : library_statistics()) {
    values_.emplace_back(statistic.name, read(placement, statistic));
  }
  edge_bands_ = read_edge_bands(placement);
  cell_bands_ = read_cell_bands(placement);
}

void Statistics::renew_memory(pnpbs_placement placement) {
  for (const LibraryStatistic& statistic : library_statistics()) {
    if (!statistic.name.starts_with("memory.")) continue;
    for (auto& [name, value] : values_) {
      if (name == statistic.name) value = read(placement, statistic);
    }
  }
}

}  // namespace pnpbs::tool
