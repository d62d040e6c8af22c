// SPDX-License-Identifier: BSD-3-Clause
#include "checkpoint/saving.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "base/error.hpp"
#include "base/limits.hpp"
#include "base/point_text.hpp"
#include "checkpoint/domain_fingerprint.hpp"
#include "checkpoint/option_changes.hpp"
#include "checkpoint/saved_warnings.hpp"
#include "comm/records.hpp"
#include "level/exchange.hpp"
#include "level/node_spacing.hpp"
#include "level/plane/closed_sphere.hpp"
#include "level/reach.hpp"
#include "spacing/nodal_spacing.hpp"

namespace pnpbs {

namespace {

// Throws the error of a damaged checkpoint.
[[noreturn]] void damaged(const MessageText& what) { throw Error(ErrorKind::file, what); }

bool is_flag(std::int64_t value) { return value == 0 || value == 1; }

// Returns true if the boundary data of a node are possible on this level.
bool fits_geometry(const LevelGeometry<2>& geometry, const PackedNode<2>& node) {
  if (node.carrier == Carrier::free) return node.boundary_node == -1;
  if (node.carrier != Carrier::fixed) return false;
  if (node.boundary_node == -1) return geometry.domain().is_in_margin(node.x);  // held there
  return node.boundary_node >= 0 && node.boundary_node < geometry.boundary_nodes() &&
         geometry.boundary().nodes[static_cast<std::size_t>(node.boundary_node)].position == node.x;
}
bool fits_geometry(const LevelGeometry<3>& geometry, const PackedNode<3>& node) {
  const auto in = [](std::int32_t index, std::size_t n) {
    return index >= 0 && static_cast<std::size_t>(index) < n;
  };
  switch (node.carrier) {
    case Carrier::free:
      return node.boundary_node == -1 && node.reference_on == -1;
    case Carrier::surface:
      return in(node.boundary_node, geometry.boundary().facets.size()) &&
             in(node.reference_on, geometry.boundary().facets.size());
    case Carrier::fixed:
    case Carrier::curve:
      return in(node.boundary_node, geometry.features().nodes.size()) &&
             in(node.reference_on, geometry.features().nodes.size());
  }
  return false;
}

// Throws if the id, position, velocity or spacing of a node is invalid.
template <int Dim>
void require_possible_node(const Level<Dim>& level, const SavedState& state,
                           const PackedNode<Dim>& node) {
  const Box<Dim>& bounds = level.geometry.bounds();
  const double margin = size_of(bounds);  // nodes on a level set may be slightly outside
  bool inside = level.nodes.cell.image_of(node.x) == Image<Dim>{};
  for (int k = 0; k < Dim; ++k)
    inside = inside && node.x[k] >= bounds.low[k] - margin && node.x[k] <= bounds.high[k] + margin;
  const MessageText which = "node " + std::to_string(node.id) + " at " + point_text(node.x);
  const PeriodicCell<Dim>& cell = level.nodes.cell;
  const std::int64_t number = cell.number_of(node.id);
  if (number < 0 || number >= state.next_id || cell.home_id(node.id) != node.id)
    damaged(which + ": ids must be at least 0 and less than " + std::to_string(state.next_id) +
            ": it is damaged");
  if (!inside || (node.carrier == Carrier::free &&
                  level.map().leaf_outside(level.map().tree().leaf_at(node.x))))
    damaged(which + " is outside of the domain: it is damaged");
  if (!is_usable(node.v) || !is_usable(node.reference) || !(node.d > 0) || !is_usable(node.d))
    damaged(which +
            ": its velocity, reference position or spacing is not a possible value: it "
            "is damaged");
}

// Throws if an id occurs twice on all ranks together. Collective.
template <int Dim>
void require_unique_ids(const Communicator& comm, const std::vector<SavedNode<Dim>>& nodes) {
  std::vector<std::int64_t> ids;
  for (const SavedNode<Dim>& saved : nodes) ids.push_back(saved.node.id);
  std::vector<std::int64_t> here = redistribute<std::int64_t>(comm, ids, [&](std::int64_t id) {
    return static_cast<int>(static_cast<std::uint64_t>(id) %
                            static_cast<std::uint64_t>(comm.size()));
  });
  collective_try(comm, [&] {
    std::sort(here.begin(), here.end());
    const auto twice = std::adjacent_find(here.begin(), here.end());
    if (twice != here.end())
      damaged("node " + std::to_string(*twice) + " occurs twice: it is damaged");
  });
}

// Sends each node to the rank that owns its position and adds it to the level there. Collective.
template <int Dim>
void put_saved_nodes(Level<Dim>& level, const SavedState& state,
                     std::vector<SavedNode<Dim>>& saved) {
  const Communicator& comm = *level.comm;
  collective_try(comm, [&] {
    for (const SavedNode<Dim>& one : saved)
      if (!is_usable(one.node.x))
        damaged("node " + std::to_string(one.node.id) + " at " + point_text(one.node.x) +
                " has coordinates that are not usable: it is damaged");
  });
  if (level.distributed())
    saved = redistribute(
        comm, saved, [&](const SavedNode<Dim>& one) { return level.tree->owner_at(one.node.x); });
  collective_try(comm, [&] {
    Nodes<Dim>& nodes = level.nodes;
    nodes.reserve_with_room(std::ssize(saved));
    for (const SavedNode<Dim>& one : saved) {
      require_possible_node(level, state, one.node);
      append(nodes, one.node, true);
    }
    nodes.moving = static_cast<Carrier>(state.moving);
  });
  require_unique_ids(comm, saved);
  level.next_id = state.next_id;
}

// Throws if nodes do not fit the boundary of the level. As the spacing is known to be the same, so
// should the boundary be. Collective.
template <int Dim>
void require_same_boundary(const Level<Dim>& level, const std::vector<SavedNode<Dim>>& saved) {
  collective_try(*level.comm, [&] {
    for (const SavedNode<Dim>& one : saved)
      if (!fits_geometry(level.geometry, one.node))
        damaged(
            "node " + std::to_string(one.node.id) + " at " + point_text(one.node.x) +
            " is not at a node of the boundary of this domain: it is damaged, or a curve given by "
            "a callback has changed");
  });
}

// Throws if d at a node differs from the saved value. Called before any node moves. Collective.
template <int Dim>
void require_same_spacing(const Level<Dim>& level, const std::vector<SavedNode<Dim>>& saved) {
  const View<double> d = spacing_at_owned_nodes(level, level.geometry.spacing());
  collective_try(*level.comm, [&] {
    for (std::size_t k = 0; k < saved.size(); ++k) {
      const double here = d(static_cast<std::int64_t>(k));
      if (here == saved[k].spacing) continue;
      throw Error(ErrorKind::spacing, "the spacing is not the one it was written with: at " +
                                          point_text(saved[k].node.x) + " it is " +
                                          number_text(here) + ", and it was " +
                                          number_text(saved[k].spacing));
    }
  });
}

// Throws if the global state is one that no placement can have.
void require_possible(const SavedState& s) {
  warnings_in(s.warnings);
  const auto count = [](std::int64_t n) { return n >= 0; };
  const bool flags = is_flag(s.refined) && is_flag(s.coarser) && is_flag(s.taken_over) &&
                     is_flag(s.ended) && is_flag(s.population_settled) && is_flag(s.at_event) &&
                     is_flag(s.spacing_saved);
  const bool counts = s.nodes > 0 && count(s.next_id) && count(s.step) && count(s.steps_done) &&
                      count(s.inserted) && count(s.deleted) && count(s.dropped) &&
                      count(s.held_rounds) && count(s.start_nodes_before_reduction) &&
                      count(s.rebuilds) && count(s.rebalances) && count(s.missing_faces) &&
                      count(s.left_out) && count(s.quiet_events) && s.quiet_events < 1 << 30 &&
                      count(s.coarser_levels) && s.coarser_levels < 1 << 10;
  const bool kinds = (s.moving == static_cast<int>(Carrier::free) ||
                      (s.dimension == 3 && s.moving == static_cast<int>(Carrier::surface))) &&
                     s.stop_reason >= 0 && s.stop_reason <= static_cast<int>(StopReason::monitor) &&
                     s.outcome >= 0 && s.outcome <= static_cast<int>(Outcome::not_conforming);
  if (!flags || !counts || !kinds || s.coarser)
    damaged("its record of the run is impossible: it is damaged");
}

// Calls visit(row) for each row of a table, which has `length` numbers. Throws if the last row is
// incomplete.
template <class Visit>
void for_rows(const std::vector<double>& table, std::size_t length, const char* what,
              const Visit& visit) {
  if (table.size() % length != 0)
    damaged(std::string("its table of ") + what + " is cut off: it is damaged");
  for (std::size_t k = 0; k < table.size(); k += length) visit(table.data() + k);
}

template <int Dim>
Point<Dim> point_in(const double* row) {
  Point<Dim> x;
  std::copy_n(row, Dim, x.begin());
  return x;
}

template <int Dim>
void append(std::vector<double>& table, const GrowthSource<Dim>& source) {
  table.insert(table.end(), source.x.begin(), source.x.end());
  table.push_back(source.d);
}

template <int Dim>
std::vector<GrowthSource<Dim>> sources_in(const std::vector<double>& table, const char* what) {
  std::vector<GrowthSource<Dim>> sources;
  for_rows(table, Dim + 1, what, [&](const double* row) {
    const GrowthSource<Dim> source{point_in<Dim>(row), row[Dim]};
    if (!is_usable(source.x) || !(source.d > 0) || !is_usable(source.d))
      damaged(std::string("its table of ") + what + " has d = " + number_text(source.d) + " at " +
              point_text(source.x) + ": it is damaged");
    sources.push_back(source);
  });
  return sources;
}

template <int Dim>
LocalReduction<Dim> held_in(const SavedState& state) {
  if (!(state.least_before_held >= 0) || !is_usable(state.least_before_held))
    damaged("the smallest d before its reduction is " + number_text(state.least_before_held) +
            ": it is damaged");
  return {sources_in<Dim>(state.held, "places where d is reduced"), state.held_rounds,
          state.start_nodes_before_reduction, state.least_before_held};
}

// Returns the fingerprint of the domain that the user gives. The domain of a level has further
// images of a periodic cell.
template <int Dim>
std::uint64_t fingerprint_of_given(const Domain<Dim>& domain) {
  if (!domain.cell().any()) return fingerprint_of(domain);
  Domain<Dim> given = domain;
  given.set_reach(0);
  given.check();
  return fingerprint_of(given);
}

template <int Dim>
void save_undersampled_points(const SpacingHints<Dim>& finer, SavedState& s) {
  for (const GrowthSource<Dim>& place : finer.in_domain) append(s.undersampled_points, place);
  for (const auto& slope : finer.slopes) {
    s.finer_slopes.insert(s.finer_slopes.end(), slope.at.begin(), slope.at.end());
    for (const double number : {slope.growth, slope.d, slope.in_domain ? 1.0 : 0.0})
      s.finer_slopes.push_back(number);
  }
}

void save_edge_bands(const std::vector<EdgeBand>& bands, SavedState& s) {
  for (const EdgeBand& band : bands)
    for (const double number : {band.from, band.to, static_cast<double>(band.ratio.edges),
                                band.ratio.mean, band.ratio.deviation})
      s.edge_bands.push_back(number);
}

std::vector<EdgeBand> edge_bands_in(const SavedState& s) {
  constexpr double kMost = 1e15;
  std::vector<EdgeBand> bands;
  for_rows(s.edge_bands, 5, "edges by bands of d", [&](const double* row) {
    if (!(row[2] >= 0 && row[2] < kMost)) damaged("a band of d has no edges: it is damaged");
    bands.push_back({row[0], row[1], {static_cast<std::int64_t>(row[2]), row[3], row[4]}});
  });
  return bands;
}

}  // namespace

template <int Dim>
SpacingHints<Dim> undersampled_points_of(const SavedState& saved) {
  SpacingHints<Dim> finer;
  finer.in_domain = sources_in<Dim>(saved.undersampled_points, "places with a smaller d");
  for_rows(saved.finer_slopes, Dim + 3, "slopes of d", [&](const double* row) {
    const double *growth = row + Dim, *d = growth + 1, *in_domain = d + 1;
    if (!is_usable(point_in<Dim>(row)) || !is_usable(*growth) || !(*d > 0) || !is_usable(*d))
      damaged("its table of slopes of d has d = " + number_text(*d) + " at " +
              point_text(point_in<Dim>(row)) + ": it is damaged");
    finer.slopes.push_back({*growth, *d, point_in<Dim>(row), *in_domain != 0});
  });
  return finer;
}

template <int Dim>
Saved<Dim> saved_of(const Level<Dim>& level, const PlacedSpacing<Dim>& placed,
                    const SizingField<Dim>& spacing, const RunState& run, const Options& options,
                    bool at_event) {
  Saved<Dim> saved;
  SavedState& s = saved.state;
  const LocalReduction<Dim>& held = placed.held;
  saved.nodes = &level.nodes;
  saved.spacing = spacing_at_owned_nodes(level, level.geometry.spacing());
  std::uint64_t checksum = 0;
  collective_try(*level.comm, [&] {
    for (std::int32_t i = 0; i < level.nodes.count; ++i)
      if (level.nodes.owned(i)) saved.owned.push_back(i);
    for (std::int64_t k = 0; k < saved.count(); ++k) checksum += checksum_of(saved.node(k));
    s.warnings = saved_warnings(std::span(run.warnings).subspan(run.warnings_of_level));
    s.options = lines_of_deciding(options.in(Dim));
    if (const auto* nodal = dynamic_cast<const NodalSpacing<Dim>*>(&spacing.source()))
      saved.patch = &nodal->patch();
  });
  s.dimension = Dim;
  s.nodes = static_cast<std::int64_t>(
      level.comm->allreduce_sum(static_cast<std::uint64_t>(saved.count())));
  s.next_id = level.next_id;
  s.moving = static_cast<int>(level.nodes.moving);
  s.step = run.schedule.step;
  s.refined = run.schedule.refined();
  s.coarser = run.schedule.role != LevelRole::result;
  s.taken_over = run.schedule.taken_over();
  s.ended = run.schedule.ended();
  s.population_settled = run.schedule.population_settled;
  s.quiet_events = run.schedule.quiet_events;
  s.at_event = at_event || run.schedule.progress == Progress::at_event;
  s.coarser_levels = run.coarser_levels;
  s.steps_done = run.steps_done;
  s.inserted = run.inserted;
  s.deleted = run.deleted;
  s.dropped = run.dropped;
  s.rebuilds = run.rebuilds_before + level.neighbourhood.rebuilds();
  s.rebalances = run.rebalances_before + level.rebalances;
  s.stop_reason = static_cast<int>(run.stop_reason);
  s.outcome = static_cast<int>(run.outcome);
  s.missing_faces = run.surface_fit.faces_off;
  s.left_out = level.left_out;
  s.spacing_saved = saved.patch != nullptr;
  s.max_speed = run.last_speeds.max;
  s.mean_speed = run.last_speeds.mean;
  s.meeting_radius = meeting_radius(level.settings);
  s.held_rounds = held.rounds;
  s.start_nodes_before_reduction = held.start_nodes;
  s.least_before_held = held.least_before;
  s.count_factor = placed.count_factor;
  collective_try(*level.comm, [&] {
    for (const GrowthSource<Dim>& place : held.places) append(s.held, place);
    save_undersampled_points(spacing.undersampled_points(), s);
    save_edge_bands(run.edge_bands, s);
    s.steepest.assign(placed.steepest.at.begin(), placed.steepest.at.end());
    s.steepest.push_back(placed.steepest.growth);
  });
  collective_try(*level.comm, [&] {
    s.domain_fingerprint = fingerprint_of_given<Dim>(level.geometry.domain());
  });
  s.checksum = level.comm->allreduce_sum(checksum) + checksum_of_tables(s);
  return saved;
}

void require_savable_spacing(bool replaced, const Options& now, const Options& then) {
  const auto refuse = [](const std::string& what) {
    throw Error(ErrorKind::state, "the nodes are those of another " + what +
                                      ": write the checkpoint before it is set, or after a run");
  };
  if (replaced) refuse("spacing");
  if (now.integer("resolve") != then.integer("resolve")) refuse("value of the option resolve");
  for (const char* option : {"wanted_nodes", "growth_limit"})
    if (now.real(option) != then.real(option) || now.is_set(option) != then.is_set(option))
      refuse(std::string("value of the option ") + option);
}

template <int Dim>
void require_same_as(const SavedState& saved, const Communicator& comm, Domain<Dim>& domain,
                     const Options& options) {
  collective_try(comm, [&] { domain.check(); });
  require_same_domain(comm, domain);
  if (saved.dimension != Dim)
    throw Error(ErrorKind::argument, "it is of a placement in " + std::to_string(saved.dimension) +
                                         " dimensions, not in " + std::to_string(Dim));
  require_possible(saved);
  if (saved.domain_fingerprint != fingerprint_of(domain))
    throw Error(ErrorKind::domain, "the domain is not the one it was written with");
  changes_since(saved.options, options.in(Dim));
}

template <int Dim>
std::shared_ptr<Level<Dim>> saved_level(const SavedState& saved, std::vector<SavedNode<Dim>> nodes,
                                        LevelBuilder<Dim>& builder,
                                        const EffectiveSpacing<Dim>& to_place,
                                        const Settings& settings, PlacedSpacing<Dim>& placed) {
  placed.held = held_in<Dim>(saved);
  if (!(saved.count_factor > 0) || !is_usable(saved.count_factor))
    damaged("the factor on d for the number of nodes is " + number_text(saved.count_factor) +
            ": it is damaged");
  placed.count_factor = saved.count_factor;
  for_rows(saved.steepest, Dim + 1, "the growth of the spacing", [&](const double* row) {
    placed.steepest.at = point_in<Dim>(row);
    placed.steepest.growth = row[Dim];
    placed.steepest_is_known = true;
  });
  std::shared_ptr<Level<Dim>> level = builder.level_to_place(to_place, settings, placed);
  put_saved_nodes(*level, saved, nodes);
  require_same_spacing(*level, nodes);
  require_same_boundary(*level, nodes);
  // Does what the next step would have done after a change of the options.
  if (saved.meeting_radius != meeting_radius(settings)) level->nodes.set_reference_positions();
  recognise_margin(*level);
  exchange(*level, kStarHops);
  return level;
}

template <int Dim>
void adopt_state(const SavedState& s, RunState& run, Level<Dim>& level) {
  run.schedule = Schedule();
  run.schedule.step = s.step;
  run.schedule.first_nodes = first_nodes_of(s.refined, s.taken_over);
  run.schedule.progress = s.ended      ? Progress::ended
                          : s.at_event ? Progress::at_event
                                       : Progress::steps;
  run.schedule.population_settled = s.population_settled;
  run.schedule.quiet_events = static_cast<int>(s.quiet_events);
  run.coarser_levels = static_cast<int>(s.coarser_levels);
  run.last_speeds = {s.max_speed, s.mean_speed};
  run.steps_done = s.steps_done;
  run.inserted = s.inserted;
  run.deleted = s.deleted;
  run.dropped = s.dropped;
  run.rebuilds_before = s.rebuilds;
  run.rebalances_before = s.rebalances;
  run.stop_reason = static_cast<StopReason>(s.stop_reason);
  run.outcome = static_cast<Outcome>(s.outcome);
  run.edge_bands = edge_bands_in(s);
  run.surface_fit.faces_off = s.missing_faces;
  level.left_out = s.left_out;
  level.held_rounds = s.held_rounds;
  const std::vector<Warning> of_run = warnings_in(s.warnings);
  run.warnings.insert(run.warnings.end(), of_run.begin(), of_run.end());
}

template SpacingHints<2> undersampled_points_of(const SavedState&);
template Saved<2> saved_of(const Level<2>&, const PlacedSpacing<2>&, const SizingField<2>&,
                           const RunState&, const Options&, bool);
template void require_same_as<2>(const SavedState&, const Communicator&, Domain<2>&,
                                 const Options&);
template std::shared_ptr<Level<2>> saved_level(const SavedState&, std::vector<SavedNode<2>>,
                                               LevelBuilder<2>&, const EffectiveSpacing<2>&,
                                               const Settings&, PlacedSpacing<2>&);
template void adopt_state(const SavedState&, RunState&, Level<2>&);
template SpacingHints<3> undersampled_points_of(const SavedState&);
template Saved<3> saved_of(const Level<3>&, const PlacedSpacing<3>&, const SizingField<3>&,
                           const RunState&, const Options&, bool);
template void require_same_as<3>(const SavedState&, const Communicator&, Domain<3>&,
                                 const Options&);
template std::shared_ptr<Level<3>> saved_level(const SavedState&, std::vector<SavedNode<3>>,
                                               LevelBuilder<3>&, const EffectiveSpacing<3>&,
                                               const Settings&, PlacedSpacing<3>&);
template void adopt_state(const SavedState&, RunState&, Level<3>&);

}  // namespace pnpbs
