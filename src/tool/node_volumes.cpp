// SPDX-License-Identifier: BSD-3-Clause
#include "tool/node_volumes.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/exact_sum.hpp"

namespace pnpbs::tool {
namespace {

// Of some nodes. The sums are exact, so it does not matter which rank has which nodes.
struct Figures {
  std::int64_t nodes = 0;
  ExactSum volumes, ratios;
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();

  void add(double volume, double ratio) {
    ++nodes;
    volumes.add(volume);
    ratios.add(ratio);
    min = std::min(min, ratio);
    max = std::max(max, ratio);
  }

  void add(const Figures& other) {
    nodes += other.nodes;
    volumes.add(other.volumes);
    ratios.add(other.ratios);
    min = std::min(min, other.min);
    max = std::max(max, other.max);
  }
};

std::vector<double> spacing_at_nodes(pnpbs_placement placement, std::size_t nodes,
                                     pnpbs_context context) {
  std::vector<double> spacing(nodes);
  check(pnpbs_placement_get_nodes(placement, static_cast<std::int64_t>(nodes), nullptr, nullptr,
                                  nullptr, spacing.data()),
        context);
  return spacing;
}

std::vector<double> volumes_of(pnpbs_voronoi cells, pnpbs_context context) {
  std::int64_t nodes = 0;
  check(pnpbs_voronoi_sizes(cells, nullptr, &nodes, nullptr), context);
  std::vector<double> volumes(static_cast<std::size_t>(nodes));
  check(pnpbs_voronoi_get_cells(cells, nodes, volumes.data(), nullptr), context);
  return volumes;
}

}  // namespace

VolumeFigures volume_figures(int dimension, std::span<const double> volumes,
                             std::span<const double> spacing, const Ranks& ranks) {
  Figures own, all;
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    const double d = spacing[i];
    own.add(volumes[i], volumes[i] / (dimension == 2 ? d * d : d * d * d));
  }
  for (const Figures& of_rank : ranks.gather(std::vector<Figures>{own})) all.add(of_rank);
  if (!ranks.is_first()) return {};
  return {
      dimension, all.volumes.value(), all.ratios.value() / static_cast<double>(all.nodes), all.min,
      all.max,   std::nullopt};
}

VolumeFigures add_volumes(pnpbs_placement placement, int dimension,
                          const std::optional<Density>& density, pnpbs_context context,
                          const Ranks& ranks) {
  Voronoi cells;
  std::vector<double> volumes, spacing, x;
  const AddField add = [&](const char* name, const std::vector<double>& values) {
    check(pnpbs_placement_add_output_field(placement, name, std::ssize(values), 1, values.data()),
          context);
  };
  check(pnpbs_voronoi_create(placement, cells.out()), context);
  ranks.agreed([&] {
    volumes = volumes_of(cells, context);
    spacing = spacing_at_nodes(placement, volumes.size(), context);
    add("volume", volumes);
    if (density) x = coordinates_of(placement, density->dimension(), context);
  });
  VolumeFigures figures = volume_figures(dimension, volumes, spacing, ranks);
  if (density) figures.mass = add_masses(*density, x, volumes, add, ranks);
  return figures;
}

}  // namespace pnpbs::tool
