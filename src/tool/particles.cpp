// SPDX-License-Identifier: BSD-3-Clause
#include "tool/particles.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace pnpbs::tool {
namespace {

// Of this rank.
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
  ranks.agreed([&] {
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

}  // namespace pnpbs::tool
