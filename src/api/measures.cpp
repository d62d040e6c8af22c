// SPDX-License-Identifier: BSD-3-Clause
// C interface: measures of a placement, namely edge lengths and Voronoi cells by bands of d, the
// regions, and the estimate of a run.
#include "api/placement_calls.hpp"
#include "results/region_figures.hpp"
#include "settings/named_rows.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

namespace {

struct CellMeasureRow {
  const char* name;
  CellFigure CellShape::*figure;
};

const CellFigure& figure_of(const CellShape& shape, const char* measure) {
  static const std::vector<CellMeasureRow> table = {{"edge_ratio", &CellShape::edge_ratio},
                                                    {"area_ratio", &CellShape::area_ratio},
                                                    {"dual_offset", &CellShape::dual_offset}};
  return shape.*row_named(measure, table, "measure of cells").figure;
}

}  // namespace

pnpbs_status pnpbs_placement_get_edge_bands(pnpbs_placement placement, int64_t capacity,
                                            int64_t* count, double* d_from, double* d_to,
                                            int64_t* edges, double* mean, double* deviation) {
  return collective(placement, [&](Placement& p) {
    require_pointer(count, "count");
    const std::vector<EdgeBand>& bands = p.results().element_quality().bands;
    *count = static_cast<std::int64_t>(bands.size());
    if (capacity == 0 && !d_from && !d_to && !edges && !mean && !deviation) return PNPBS_OK;
    require_capacity(capacity, *count);
    for (std::size_t k = 0; k < bands.size(); ++k) {
      if (d_from) d_from[k] = bands[k].from;
      if (d_to) d_to[k] = bands[k].to;
      if (edges) edges[k] = bands[k].ratio.edges;
      if (mean) mean[k] = bands[k].ratio.mean;
      if (deviation) deviation[k] = bands[k].ratio.deviation;
    }
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_regions(pnpbs_placement placement, int64_t capacity,
                                         int64_t* count, int32_t* tags, int64_t* nodes,
                                         int64_t* elements, double* measures) {
  return collective_results(placement, [&](NodalResults& results) {
    require_pointer(count, "count");
    require_inside(results);
    const std::vector<RegionFigures> regions =
        visit_dimension(results, [](auto& in) { return region_figures(in); });
    *count = std::ssize(regions);
    if (capacity == 0 && !tags && !nodes && !elements && !measures) return PNPBS_OK;
    require_capacity(capacity, *count);
    for (std::size_t k = 0; k < regions.size(); ++k) {
      if (tags) tags[k] = regions[k].tag;
      if (nodes) nodes[k] = regions[k].nodes;
      if (elements) elements[k] = regions[k].elements;
      if (measures) measures[k] = regions[k].measure;
    }
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_cell_bands(pnpbs_placement placement, const char* measure,
                                            int64_t capacity, int64_t* count, double* d_from,
                                            double* d_to, int64_t* number, double* mean,
                                            double* worst) {
  return collective(placement, [&](Placement& p) {
    require_pointer(measure, "measure");
    require_pointer(count, "count");
    figure_of({}, measure);  // throws if there is no such measure
    const std::vector<CellBand>& bands = p.results().element_quality().cell.bands;
    *count = static_cast<std::int64_t>(bands.size());
    if (capacity == 0 && !d_from && !d_to && !number && !mean && !worst) return PNPBS_OK;
    require_capacity(capacity, *count);
    for (std::size_t k = 0; k < bands.size(); ++k) {
      const CellFigure& figure = figure_of(bands[k].shape, measure);
      if (d_from) d_from[k] = bands[k].from;
      if (d_to) d_to[k] = bands[k].to;
      if (number) number[k] = figure.number;
      if (mean) mean[k] = figure.mean;
      if (worst) worst[k] = figure.worst;
    }
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_estimate(pnpbs_placement placement, int64_t* nodes, int64_t* bytes,
                                      double* seconds) {
  return collective(placement, [&](Placement& p) {
    const Estimate estimate = p.estimate();
    if (nodes) *nodes = estimate.nodes;
    if (bytes) *bytes = estimate.bytes;
    if (seconds) *seconds = estimate.seconds;
    return PNPBS_OK;
  });
}
