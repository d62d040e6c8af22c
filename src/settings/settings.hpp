// SPDX-License-Identifier: BSD-3-Clause
// The options of a placement as the numbers the method works with.
#pragma once

#include <cstdint>
#include <limits>

#include "domain/node_limit.hpp"
#include "dynamics/pair_laws.hpp"
#include "dynamics/schemes.hpp"
#include "population/population.hpp"
#include "quality/plane/bad_triangles.hpp"
#include "quality/plane/defects.hpp"
#include "quality/sweep.hpp"
#include "settings/options.hpp"

namespace pnpbs {

struct Settings {
  // The defaults of some depend on the dimension.
  Settings(const Options& options, int dimension);
  explicit Settings(const Options& options);

  int bubble_dimension = 2;  // of what the bubbles fill: 3 inside a volume, 2 on a surface
  bool cubic_law;            // equation (2) of the paper; otherwise DefaultLaw
  bool predictor_corrector;  // otherwise one force evaluation per step
  bool runge_kutta_finish;
  double rest_length;
  Motion motion;
  std::int64_t steps;
  int levels;                   // coarser ones
  std::int64_t coarsest_steps;  // on the coarsest of several levels
  std::int64_t refined_steps;   // on those between it and the finest
  std::int64_t event_interval;
  double population_share;      // of the steps
  double population_tolerance;  // share of the nodes
  PopulationRule population;
  double tolerance_mean, tolerance_max;  // scaled speeds
  bool first_row;  // of one node over each regular edge of the boundary, in the plane
  std::int64_t sweeps;
  SweepRule sweep;
  RepairRule repair;
  std::int64_t centroidal_sweeps;
  std::int64_t obtuse_rounds;
  double sliver_angle;  // degrees
  DefectRule defects;
  double list_radius, adjacency_radius;
  double growth_limit;
  bool growth_limit_set;  // by the user: otherwise it counts where nodes could not follow d
  bool resolve;           // hold d down where it does not resolve the shape, in space
  std::int64_t conforming_rounds;
  double min_angle;  // degrees
  std::int64_t max_nodes;
  double max_memory;                                           // share of what there is; 0: any
  double max_bytes = std::numeric_limits<double>::infinity();  // the placement's business
  std::int64_t exchange_interval;                              // steps
  std::int64_t metis_seed;
  double rebalance_above;  // largest over mean owned work

  bool lays_first_row() const { return first_row && sweeps > 0; }  // which sweeps must relax
  bool user_limits_growth() const { return growth_limit_set && growth_limit > 0; }
  NodeLimit node_limit() const {
    NodeLimit limit(max_nodes, max_bytes);
    limit.resolves = resolve;
    return limit;
  }
  int evaluations_per_step() const { return predictor_corrector ? 2 : 1; }
  double force_range() const { return cubic_law ? CubicLaw{}.range : rest_length; }
};

}  // namespace pnpbs
