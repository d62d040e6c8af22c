// SPDX-License-Identifier: BSD-3-Clause
#include "tool/particles.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "base/exact_sum.hpp"
#include "tool/centred_nodes.hpp"

namespace pnpbs::tool {
namespace {

// Sums over some nodes. They are exact, so the result does not depend on the distribution over
// ranks.
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
  ranks.collective_try([&] {
    volumes = volumes_of(cells, context);
    spacing = spacing_at_nodes(placement, volumes.size(), context);
    add("volume", volumes);
    if (density) x = coordinates_of(placement, density->dimension(), context);
  });
  VolumeFigures figures = volume_figures(dimension, volumes, spacing, ranks);
  if (density) figures.mass = add_masses(*density, x, volumes, add, ranks);
  return figures;
}

namespace {

// The arrays of this rank's particles.
struct Arrays {
  std::int32_t dimension = 0;
  std::vector<double> x, volumes, spacing;
  std::vector<std::int32_t> tags;

  Arrays(pnpbs_particles particles, pnpbs_context context) {
    std::int64_t count = 0;
    check(pnpbs_particles_sizes(particles, &dimension, &count, nullptr), context);
    const auto n = static_cast<std::size_t>(count);
    x.resize(n * static_cast<std::size_t>(dimension));
    volumes.resize(n), spacing.resize(n), tags.resize(n);
    check(pnpbs_particles_get(particles, count, x.data(), volumes.data(), spacing.data(), nullptr,
                              tags.data()),
          context);
  }
};

std::int64_t sum_over_ranks(std::int64_t own, const Ranks& ranks) {
  const std::vector<std::int64_t> all = ranks.gather(std::vector<std::int64_t>{own});
  return std::accumulate(all.begin(), all.end(), std::int64_t{0});
}

}  // namespace

Matter::Matter(const Arguments& arguments, const std::optional<Density>& density, int dimension,
               pnpbs_placement placement, pnpbs_domain body, pnpbs_context context,
               const Ranks& ranks) {
  if (arguments.at_centres) {
    make_particles(density, centred_nodes(dimension), placement, body, context, ranks);
    figures->of_wall = arguments.in_walls;
  } else if (arguments.volumes || density) {
    const bool of_areas = arguments.surfaces_only || arguments.sphere;
    volumes = add_volumes(placement, of_areas ? 2 : dimension, density, context, ranks);
  }
}

void Matter::make_particles(const std::optional<Density>& density, const CentredNodes& centred,
                            pnpbs_placement placement, pnpbs_domain body, pnpbs_context context,
                            const Ranks& ranks) {
  check(pnpbs_particles_create(placement, body, particles.out()), context);
  ParticleFigures& all = figures.emplace();
  std::optional<Arrays> own;
  ranks.collective_try([&] {
    check(pnpbs_particles_sizes(particles, nullptr, nullptr, &all.count), context);
    check(pnpbs_particles_figures(particles, &all.left_out, &all.moved, &all.closest), context);
    all.closest *= centred.bubbles;
    own.emplace(particles, context);
    for (double& d : own->spacing) d /= centred.bubbles;
  });
  all.outermost = sum_over_ranks(
      std::ranges::count_if(own->tags, [](std::int32_t tag) { return tag != 0; }), ranks);
  volumes = volume_figures(own->dimension, own->volumes, own->spacing, ranks);
  if (!density) return;
  const AddField add = [&](const char* name, const std::vector<double>& values) {
    check(pnpbs_particles_add_output_field(particles, name, std::ssize(values), 1, values.data()),
          context);
  };
  volumes->mass = add_masses(*density, own->x, own->volumes, add, ranks);
}

void ParticleDomains::make(const Arguments& arguments, Spacing& spacing, pnpbs_domain body,
                           int dimension, pnpbs_context context) {
  const CentredNodes nodes = centred_nodes(dimension);
  const auto add = [&](Domain& domain, const Band& band) {
    check(pnpbs_domain_create(context, dimension, domain.out()), context);
    spacing.add_band(domain, body, band, context);
  };
  if (arguments.in_walls) {
    const int layers = arguments.wall_layers.value_or(default_wall_layers);
    add(filled, nodes.in_wall(layers));
    add(wall, nodes.wall(layers));
  } else {
    add(filled, nodes.inside());
  }
  spacing.multiply(nodes.bubbles);
}

}  // namespace pnpbs::tool
