// SPDX-License-Identifier: BSD-3-Clause
#include "settings/settings.hpp"

namespace pnpbs {

Settings::Settings(const Options& options, int dim) : Settings(options.in(dim)) {}

Settings::Settings(const Options& o)
    : bubble_dimension(o.dimension()),
      cubic_law(o.choice("law") == "cubic"),
      predictor_corrector(o.choice("scheme") == "predictor_corrector"),
      runge_kutta_finish(o.choice("finish") == "runge_kutta"),
      rest_length(o.real("rest_length")),
      steps(o.integer("steps")),
      levels(static_cast<int>(o.integer("levels"))),
      coarsest_steps(o.integer("coarsest_steps")),
      refined_steps(o.integer("refined_steps")),
      event_interval(o.integer("event_interval")),
      population_share(o.real("population_share")),
      population_tolerance(o.real("population_tolerance")),
      tolerance_mean(o.real("tolerance_mean")),
      tolerance_max(o.real("tolerance_max")),
      first_row(o.integer("first_row") != 0),
      sweeps(o.integer("sweeps")),
      centroidal_sweeps(o.integer("centroidal_sweeps")),
      obtuse_rounds(o.integer("obtuse_rounds")),
      split_elements_on_boundary(o.integer("split_elements_on_boundary") != 0),
      sliver_angle(o.real("sliver_angle")),
      list_radius(o.real("list_radius")),
      adjacency_radius(o.real("adjacency_radius")),
      growth_limit(o.real("growth_limit")),
      growth_limit_set(o.is_set("growth_limit")),
      resolve(o.integer("resolve") != 0),
      conforming_rounds(o.integer("conforming_rounds")),
      min_angle(o.real("min_angle")),
      max_nodes(o.integer("max_nodes")),
      max_memory(o.real("max_memory")),
      exchange_interval(o.integer("exchange_interval")),
      metis_seed(o.integer("metis_seed")),
      rebalance_above(o.real("rebalance_above")) {
  motion.dt = o.real("time_step");
  motion.damping = o.real("damping");
  motion.max_move = o.real("max_move");
  population.dimension = bubble_dimension;
  population.ideal = bubble_dimension == 3 ? Lattice<3>::kIdealOverlap : Lattice<2>::kIdealOverlap;
  population.delete_above = o.real("delete_above");
  population.insert_below = o.real("insert_below");
  population.mean_distance = o.real("mean_distance");
  sweep.weight = o.real("sweep_weight");
  repair.rounds = o.integer("smoothing_rounds");
  defects.rounds = o.integer("topology_repairs");
  repair.bad_below = o.real("smooth_below");
  // The lists must reach beyond the range of the force, or no list could be kept for even one step.
  const double min_radius = force_range() + 0.1;
  if (list_radius < min_radius) list_radius = min_radius;
}

}  // namespace pnpbs
