// SPDX-License-Identifier: BSD-3-Clause
#include "tool/density.hpp"

#include <array>
#include <cmath>

#include "base/exact_sum.hpp"
#include "tool/numbers.hpp"

namespace pnpbs::tool {
namespace {

[[noreturn]] void refuse(double density, const std::string& where) {
  throw BadInput("--density: expected a number greater than 0, found " + short_number(density, 6) +
                 where);
}

bool is_density(double value) { return value > 0 && std::isfinite(value); }

}  // namespace

Density::Density(const std::string& text, int dimension)
    : dimension_(dimension), formula_(text, dimension, "--density") {
  constexpr double anywhere[3] = {0, 0, 0};
  if (!formula_.is_constant()) return;
  if (const double density = formula_.at(anywhere); !is_density(density)) refuse(density, "");
}

std::vector<double> Density::at(std::span<const double> x) const {
  const auto dimension = static_cast<std::size_t>(dimension_);
  std::vector<double> densities(x.size() / dimension);
  formula_.at(std::ssize(densities), x.data(), densities.data());
  for (std::size_t i = 0; i < densities.size(); ++i)
    if (!is_density(densities[i]))
      refuse(densities[i], " at " + place_text(&x[dimension * i], dimension_));
  return densities;
}

void Density::check_at_nodes_of(pnpbs_placement placement, pnpbs_context context,
                                const Ranks& ranks) const {
  ranks.collective_try([&] { at(coordinates_of(placement, dimension_, context)); });
}

std::vector<double> coordinates_of(pnpbs_placement placement, int dimension,
                                   pnpbs_context context) {
  std::int64_t nodes = 0;
  check(pnpbs_placement_count(placement, &nodes), context);
  std::vector<double> x(static_cast<std::size_t>(dimension * nodes));
  check(pnpbs_placement_get_nodes(placement, nodes, x.data(), nullptr, nullptr, nullptr), context);
  return x;
}

double add_masses(const Density& density, std::span<const double> x,
                  std::span<const double> volumes, const AddField& add, const Ranks& ranks) {
  ExactSum own, all;
  ranks.collective_try([&] {
    const std::vector<double> densities = density.at(x);
    std::vector<double> masses(densities.size());
    for (std::size_t i = 0; i < masses.size(); ++i) {
      masses[i] = densities[i] * volumes[i];
      own.add(masses[i]);
    }
    add("density", densities);
    add("mass", masses);
  });
  for (const ExactSum& of_rank : ranks.gather(std::vector<ExactSum>{own})) all.add(of_rank);
  return ranks.is_first() ? all.value() : 0;
}

}  // namespace pnpbs::tool
