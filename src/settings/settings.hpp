// SPDX-License-Identifier: BSD-3-Clause
// The options of a placement as the numbers that the method computes with.
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

// The values of all options for one dimension.
struct Settings {
  // Reads the options with the defaults for this dimension of bubbles.
  Settings(const Options& options, int dimension);
  // Reads the options with the dimension that they have.
  explicit Settings(const Options& options);

  int bubble_dimension = 2;  // 3 inside a volume, 2 in the plane and on surfaces
  bool cubic_law;            // equation (2) of the paper; otherwise DefaultLaw
  bool predictor_corrector;  // two force evaluations per step, otherwise one
  bool runge_kutta_finish;
  double rest_length;
  Motion motion;
  std::int64_t steps;
  int levels;                   // number of coarser levels
  std::int64_t coarsest_steps;  // on the coarsest of several levels
  std::int64_t refined_steps;   // on levels between the coarsest and the finest
  std::int64_t event_interval;
  double population_share;      // share of the steps
  double population_tolerance;  // share of the nodes
  PopulationRule population;
  double tolerance_mean, tolerance_max;  // scaled speeds, in spacings per unit of time
  bool first_row;                        // plane: a node over each regular edge of the boundary
  std::int64_t sweeps;
  SweepRule sweep;
  RepairRule repair;
  std::int64_t centroidal_sweeps;
  std::int64_t obtuse_rounds;
  bool split_elements_on_boundary;  // plane
  double sliver_angle;              // degrees
  DefectRule defects;
  double list_radius, adjacency_radius;
  double growth_limit;
  bool growth_limit_set;  // otherwise it applies only where nodes cannot follow d
  bool resolve;           // space: reduce d where it does not resolve the shape
  std::int64_t conforming_rounds;
  double min_angle;  // degrees
  std::int64_t max_nodes;
  double max_memory;  // share of the available memory; 0: no limit
  double max_bytes = std::numeric_limits<double>::infinity();  // set by the placement
  std::int64_t exchange_interval;                              // steps
  std::int64_t metis_seed;
  double rebalance_above;  // largest over mean owned work

  bool makes_first_row() const { return first_row && sweeps > 0; }  // sweeps must relax the row
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
