// SPDX-License-Identifier: BSD-3-Clause
//
// Options of a case that affect nodes. Most cases have few or none, so that failures are those that
// users would encounter.
#include "case.hpp"
#include "number_text.hpp"

namespace hunt {

namespace {

void add_growth(Random& random, Settings& options) {
  const char* limits[] = {"0", "0.1", "0.3", "0.8", "5"};
  if (random.chance(0.4)) options.emplace_back("growth_limit", limits[random.pick(0, 4)]);
}

void add_some(Random& random, int dim, Settings& options) {
  const auto with = [&](double share, const char* key, double low, double high) {
    const double value = random.between(low, high);
    if (random.chance(share)) options.emplace_back(key, text_of(value));
  };
  const auto with_integer = [&](double share, const char* key, int low, int high) {
    const int value = random.pick(low, high);
    if (random.chance(share)) options.emplace_back(key, std::to_string(value));
  };
  with_integer(0.3, "steps", 0, 120);
  with_integer(0.3, "levels", 0, 3);
  with_integer(0.2, "coarsest_steps", 0, 300);
  with_integer(0.2, "event_interval", 1, 30);
  with_integer(0.2, "sweeps", 0, 8);
  with_integer(0.15, "smoothing_rounds", 0, 3);
  with_integer(0.15, "topology_repairs", 0, 1);
  with(0.15, "sliver_angle", 0, 40);
  with(0.15, "list_radius", 1.5, 2.2);
  with(0.2, "adjacency_radius", 0.7, 3);
  with(0.1, "max_move", 0.01, 0.15);
  with(0.1, "rest_length", dim == 3 ? 1.1 : 1.0, 1.3);
  with(0.1, "mean_distance", 0.9, 1.1);
  with(0.1, "delete_above", dim == 3 ? 15 : 7.5, dim == 3 ? 24 : 10);
  with(0.1, "insert_below", dim == 3 ? 6 : 3, dim == 3 ? 12 : 5);
}

}  // namespace

Settings random_options(Random& random, int dim) {
  Settings options;
  add_growth(random, options);
  if (random.chance(0.4)) add_some(random, dim, options);
  if (dim == 2 && random.chance(0.1)) options.emplace_back("method", "paper");
  if (random.chance(0.04)) options.emplace_back("effort", "best");
  if (dim == 2 && random.chance(0.1)) options.emplace_back("split_elements_on_boundary", "1");
  if (dim == 3 && random.chance(0.05)) options.emplace_back("resolve", "1");
  if (dim == 3 && random.chance(0.25)) options.emplace_back("conforming_rounds", "0");
  if (dim == 3 && random.chance(0.25))
    options.emplace_back("min_angle", text_of(random.between(1, 25)));
  return options;
}

}  // namespace hunt
