// SPDX-License-Identifier: BSD-3-Clause
// A level that a test builds and advances step by step.
#pragma once

#include <cmath>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "domain/from_files.hpp"
#include "geometry/shapes.hpp"
#include "level/exchange.hpp"
#include "level/finding_stars.hpp"
#include "level/finish.hpp"
#include "level/first_nodes.hpp"
#include "level/imported_nodes.hpp"
#include "level/level.hpp"
#include "level/lists_and_stars.hpp"
#include "level/node_spacing.hpp"
#include "level/population_events.hpp"
#include "level/refinement.hpp"
#include "level/room.hpp"
#include "level/time_step.hpp"

using Plane = std::function<double(double x, double y)>;

inline std::shared_ptr<pnpbs::Spacing<2>> spacing_of(Plane d) {
  return std::make_shared<pnpbs::CallbackSpacing<2>>(
      [d = std::move(d)](std::int64_t n, const double* x, double* values) {
        for (std::int64_t i = 0; i < n; ++i) values[i] = d(x[2 * i], x[2 * i + 1]);
        return std::int32_t{0};
      });
}

inline Plane constant(double d) {
  return [d](double, double) { return d; };
}

inline pnpbs::SpacingEvaluator<2> evaluator_of(const Plane& d) {
  return [d](std::int64_t n, const pnpbs::Point<2>* x, double* values) {
    for (std::int64_t i = 0; i < n; ++i) values[i] = d(x[i][0], x[i][1]);
  };
}

inline void add_lake(pnpbs::PlaneDomain& domain, const char* name) {
  pnpbs::add_poly(
      domain, pnpbs::read_poly(std::string(PNPBS_SOURCE_DIR "/examples/data/") + name + ".poly"));
}

using Build = std::function<void(pnpbs::PlaneDomain&)>;
using OptionList = std::vector<std::pair<const char*, const char*>>;

inline void fill_level(pnpbs::Level<2>& level) {
  pnpbs::fill(level, pnpbs::BoundaryNodes<2>(level.geometry.boundary()));
}

// Returns the inner nodes as start nodes. The spacing that they were placed for is left unknown to
// take().
inline pnpbs::IncomingNodes<2> inner_nodes_of(const pnpbs::Level<2>& level) {
  pnpbs::IncomingNodes<2> inner;
  const pnpbs::Nodes<2>& nodes = level.nodes;
  for (std::int64_t i = 0; i < nodes.count; ++i)
    if (nodes.moves(i)) inner.push_back({nodes.position(i), nodes.id(i)});
  return inner;
}

struct LevelRun {
  std::shared_ptr<pnpbs::PlaneDomain> domain = std::make_shared<pnpbs::PlaneDomain>();
  std::shared_ptr<pnpbs::Communicator> comm = pnpbs::serial_communicator();
  std::unique_ptr<pnpbs::Timers> timers = std::make_unique<pnpbs::Timers>(comm->seconds_waited());
  std::unique_ptr<pnpbs::Level<2>> level;
  std::int64_t event_interval = 20;
  std::int64_t steps_done = 0;

  // Builds the level with its boundary nodes but without inner nodes.
  LevelRun(const Build& build, const Plane& d, const OptionList& options = {},
           const std::function<void(pnpbs::Settings&)>& adapt = {}) {
    build(*domain);
    domain->check();
    pnpbs::Options chosen;
    for (const auto& [key, value] : options) chosen.set(key, value);
    pnpbs::Settings settings(chosen);
    if (adapt) adapt(settings);
    event_interval = settings.event_interval;
    level = std::make_unique<pnpbs::Level<2>>(comm, domain, spacing_of(d), settings, *timers);
    level->grow_tree();
  }

  // Advances by n steps, with the events between them.
  void steps(std::int64_t n, bool rebuild_always = false, bool population = true) {
    for (const std::int64_t last = steps_done + n; steps_done < last;) {
      if (rebuild_always) pnpbs::rebuild_lists_for_steps(*level);
      std::exception_ptr failure;
      pnpbs::step(*level, failure);
      if (failure) std::rethrow_exception(failure);
      ++steps_done;
      if (steps_done % event_interval != 0) continue;
      pnpbs::refresh_spacing(*level);
      if (population) pnpbs::adjust_population(*level);
    }
  }

  void renew_stars() {
    pnpbs::rebuild_lists_for_steps(*level);
    pnpbs::rebuild_stars(*level);
  }
};
