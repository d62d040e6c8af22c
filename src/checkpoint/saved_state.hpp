// SPDX-License-Identifier: BSD-3-Clause
// The contents of a checkpoint: all state of a placement that influences further computations,
// namely global state and the nodes. What follows from the domain, the spacing and the options,
// such as the tree and the discretized boundary, is not stored. Fingerprints show whether these are
// unchanged.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/mixed_hash.hpp"
#include "partition/packed_node.hpp"

namespace pnpbs {

// The global state of a checkpoint.
struct SavedState {
  std::int64_t dimension = 0, nodes = 0, next_id = 0, moving = 0;
  // State of the schedule. at_event is 1 if the event of the last step has not yet tested whether
  // the bubbles rest.
  std::int64_t step = 0, refined = 0, coarser = 0, taken_over = 0, ended = 0,
               population_settled = 0, quiet_events = 0, at_event = 0;
  std::int64_t coarser_levels = 0, steps_done = 0, inserted = 0, deleted = 0, dropped = 0,
               rebuilds = 0, rebalances = 0, stop_reason = 0, outcome = 0, missing_faces = 0,
               spacing_saved = 0, left_out = 0;
  std::int64_t held_rounds = 0, start_nodes_before_reduction = 0;
  double max_speed = 0, mean_speed = 0, meeting_radius = 0, least_before_held = 0, count_factor = 1;
  std::uint64_t domain_fingerprint = 0;
  std::uint64_t checksum = 0;  // of the nodes in any order, and of the tables
  std::string options;         // deciding options as lines "name = value"
  std::string warnings;        // warnings of the last run, see saved_warnings.hpp

  // Tables: rows of numbers of fixed length. for_tables() visits them.
  std::vector<double> held;  // points at which d is reduced, each followed by d there
  std::vector<double> undersampled_points;  // SizingField::undersampled_points(), likewise
  std::vector<double> finer_slopes;         // point, growth, d, 1 if surely inside the domain
  std::vector<double> edge_bands;           // edge bands of the last finish
  std::vector<double> steepest;             // point of the steepest growth of d, and the growth
};

// Calls visit(name, field) for each field, which is an int64, a double, a uint64 or a string.
template <class State, class Visit>
void for_fields(State& state, const Visit& visit) {
  visit("dimension", state.dimension);
  visit("nodes", state.nodes);
  visit("next_id", state.next_id);
  visit("moving", state.moving);
  visit("step", state.step);
  visit("refined", state.refined);
  visit("coarser", state.coarser);
  visit("taken_over", state.taken_over);
  visit("ended", state.ended);
  visit("population_settled", state.population_settled);
  visit("quiet_events", state.quiet_events);
  visit("at_event", state.at_event);
  visit("coarser_levels", state.coarser_levels);
  visit("steps_done", state.steps_done);
  visit("inserted", state.inserted);
  visit("deleted", state.deleted);
  visit("dropped", state.dropped);
  visit("rebuilds", state.rebuilds);
  visit("rebalances", state.rebalances);
  visit("stop_reason", state.stop_reason);
  visit("outcome", state.outcome);
  visit("missing_faces", state.missing_faces);
  visit("spacing_saved", state.spacing_saved);
  visit("left_out", state.left_out);
  visit("held_rounds", state.held_rounds);
  visit("nodes_before_held", state.start_nodes_before_reduction);
  visit("least_before_held", state.least_before_held);
  visit("count_factor", state.count_factor);
  visit("max_speed", state.max_speed);
  visit("mean_speed", state.mean_speed);
  visit("meeting_radius", state.meeting_radius);
  visit("domain_fingerprint", state.domain_fingerprint);
  visit("checksum", state.checksum);
  visit("options", state.options);
  visit("warnings", state.warnings);
}

// Calls visit(name, numbers) for each table.
template <class State, class Visit>
void for_tables(State& state, const Visit& visit) {
  visit("held", state.held);
  visit("finer_places", state.undersampled_points);
  visit("finer_slopes", state.finer_slopes);
  visit("edge_bands", state.edge_bands);
  visit("steepest", state.steepest);
}

// Returns a hash of all tables.
inline std::uint64_t checksum_of_tables(const SavedState& state) {
  std::uint64_t h = 0;
  for_tables(state, [&](const char*, const std::vector<double>& numbers) {
    h = mixed(h ^ numbers.size());
    for (const double number : numbers) h = mixed_with(h, number);
  });
  return h;
}

// A node of a checkpoint.
template <int Dim>
struct SavedNode {
  PackedNode<Dim> node;
  double spacing;  // d at the node, which detects a changed spacing
};

// Returns a hash of a node. The sum of these hashes does not depend on the order of the nodes.
template <int Dim>
std::uint64_t checksum_of(const SavedNode<Dim>& saved) {
  const PackedNode<Dim>& node = saved.node;
  const auto word = [](std::int32_t high, std::int32_t low) {
    return std::uint64_t{static_cast<std::uint32_t>(high)} << 32 | static_cast<std::uint32_t>(low);
  };
  std::uint64_t h = mixed(static_cast<std::uint64_t>(node.id));
  for (const Point<Dim>& at : {node.x, node.v, node.reference})
    for (const double coordinate : at) h = mixed_with(h, coordinate);
  h = mixed_with(mixed_with(h, node.d), saved.spacing);
  h = mixed(h ^ word(node.tag, node.boundary_node));
  return mixed(h ^ word(node.reference_on, static_cast<std::int32_t>(node.carrier)));
}

}  // namespace pnpbs
