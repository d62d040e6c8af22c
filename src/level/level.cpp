// SPDX-License-Identifier: BSD-3-Clause
#include "level/level.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "domain/clearance.hpp"
#include "dynamics/pair_laws.hpp"

namespace pnpbs {

Level::Level(std::shared_ptr<const Communicator> comm, std::shared_ptr<const PlaneDomain> domain,
             std::shared_ptr<const Spacing<2>> spacing, const Settings& settings, Timers& timers)
    : comm_(std::move(comm)),
      domain_(std::move(domain)),
      spacing_(std::move(spacing)),
      settings_(settings),
      timers_(timers) {}

SpacingEvaluator Level::evaluator() const {
  return [this](std::int64_t n, const Point<2>* x, double* d) {
    evaluate_spacing<2>(*spacing_, domain_->area(), n, x, d);
  };
}

// ------------------------------------------------------------------ making the level -----------

void Level::discretize_boundary() {
  const PhaseTimer timer(timers_, Phase::boundary);
  boundary_ = pnpbs::discretize_boundary(*domain_, evaluator(), settings_.max_nodes);
  // Fixed nodes off the curves act as edges of no length: inner nodes keep off them, too.
  for (std::size_t f = static_cast<std::size_t>(boundary_.first_fixed); f < boundary_.nodes.size();
       ++f) {
    const std::int32_t node = static_cast<std::int32_t>(f);
    boundary_.edges.push_back({node, node, boundary_.nodes[f].tag, true, true});
  }
  sectors_.build(boundary_);
  boundary_visibility_.reset(boundary_.nodes.size());
  boundary_ids_.assign(boundary_.nodes.size(), -1);
  boundary_bound_ = bubbles_on_boundary(boundary_);
  std::vector<Point<2>> positions;
  for (const BoundaryNode& node : boundary_.nodes) positions.push_back(node.position);
  boundary_spacing_.resize(positions.size());
  evaluator()(std::ssize(positions), positions.data(), boundary_spacing_.data());
}

void Level::change_settings(const Settings& settings) {
  const double edges_before = edge_radius(), meeting_before = meeting_radius(),
               widest_before = widest_radius(), list_before = settings_.list_radius;
  settings_ = settings;
  ghost_hops_ = 0;
  if (widest_radius() != widest_before || settings_.list_radius != list_before)
    tree_hops_ = 0;  // a hop has another length now
  // Nodes count as far from the boundary by the steps that were left since their reference
  // positions.
  if (meeting_radius() != meeting_before) set_reference_positions();
  if (edge_radius() == edges_before) return;
  near_edges_.prepare(map_, *links_, edge_radius());
  lists_valid_ = false;
}

// Between events a node may come within the clearance of edges that were this far from it.
double Level::meeting_radius() const {
  const double way = settings_.motion.most * static_cast<double>(settings_.event_interval);
  return kBoundaryClearance + way;
}

double Level::edge_radius() const { return std::max(widest_radius(), meeting_radius()); }

double Level::widest_radius() const {
  return std::max(settings_.list_radius, settings_.adjacency_radius);
}

// ------------------------------------------------------------------ the time loop --------------

// A pair that was not listed, farther apart than radius times its desired distance, must not have
// come within the range of the force: each node may travel half of the difference, and a scheme
// with stages looks one move ahead. d does not change between rebuilds.
bool Level::lists_need_rebuild() const {
  const double ahead = settings_.predictor_corrector ? settings_.motion.most : 0;
  return !lists_valid_ ||
         max_displacement_ + ahead > 0.5 * (lists_.radius() - settings_.force_range());
}

void Level::rebuild_lists() {
  rebuild_lists(settings_.list_radius, nodes_.reference);
  reserve_field<2>(listed_, "pnpbs::Level::listed", nodes_.capacity());
  for_each("pnpbs::Level::listed", nodes_.count, [this](std::int64_t i) {
    for (int k = 0; k < 2; ++k) listed_[k](i) = nodes_.x[k](i);
  });
  max_displacement_ = 0;
  lists_valid_ = true;
}

// At the present positions; the next step makes its own again. Until then there are stars, and no
// need to know where nodes were: the two take their memory in turn.
void Level::rebuild_lists(double radius) {
  listed_ = {};
  lists_valid_ = false;
  rebuild_lists(radius, nodes_.x);
}

// An event: from now on visibility is judged from here.
void Level::set_reference_positions() {
  for_each("pnpbs::Level::set_reference_positions", nodes_.count, [this](std::int64_t i) {
    for (int k = 0; k < 2; ++k) nodes_.reference[k](i) = nodes_.x[k](i);
  });
  lists_valid_ = false;
  work_is_old_ = true;
}

void Level::rebuild_lists(double radius, const Field<2>& seen_from) {
  ++version_;
  const PhaseTimer timer(timers_, Phase::lists);
  if (buckets_.sort(map_.tree(), nodes_, widest_radius()))
    plan_.permute(buckets_.order(), nodes_.count);
  near_edges_.build(nodes_, seen_from, buckets_, map_);
  boundary_visibility_.look(nodes_, near_edges_, map_, sectors_);
  lists_.build(nodes_, buckets_, radius,
               VisibilityPastEdges{nodes_, near_edges_, boundary_visibility_, map_, sectors_});
  reserve_field<2>(next_, "pnpbs::Level::next", nodes_.capacity());
  set_padding();
  ++rebuilds_;
  if (work_is_old_) count_work();
}

// The far-away node behind the last one, which fills up the blocks of the lists.
void Level::set_padding() {
  for (int k = 0; k < 2; ++k) {
    nodes_.x[k](nodes_.count) = kFarAway;
    next_[k](nodes_.count) = kFarAway;
  }
  nodes_.d(nodes_.count) = 1;
}

template <class Law>
void Level::move_by(const Law& law, bool runge_kutta) {
  if (runge_kutta)
    runge_kutta_step<2>(nodes_, lists_, law, settings_.motion, stages_, next_);
  else if (settings_.predictor_corrector)
    predictor_corrector_step<2>(nodes_, lists_, law, settings_.motion, stages_, next_);
  else
    damped_step<2>(nodes_, lists_, law, settings_.motion, next_);
}

void Level::step() {
  const PhaseTimer timer(timers_, Phase::motion);
  if (settings_.cubic_law)
    move_by(CubicLaw{}, false);
  else
    move_by(LinearPush{1, settings_.rest_length}, false);
  accept_step();
}

void Level::finish_by_runge_kutta() {
  const PhaseTimer timer(timers_, Phase::motion);
  if (settings_.cubic_law)
    move_by(CubicLaw{}, true);
  else
    move_by(LinearPush{1, settings_.rest_length}, true);
  accept_step();
}

// Inner nodes near the boundary are held off it; then the new positions become the positions.
void Level::accept_step() {
  ++version_;
  constexpr std::int64_t kChunk = 64;
  const std::int64_t chunks = (nodes_.count + kChunk - 1) / kChunk;
  const double meeting = meeting_radius();
  const double square = largest_of("pnpbs::Level::take_next", chunks, 0.0, [&](std::int64_t c) {
    const std::int64_t first = c * kChunk, last = std::min(first + kChunk, nodes_.count);
    for (std::int64_t i = first; i < last; ++i)
      if (near_edges_.edge_within(i, meeting * nodes_.d(i)) && nodes_.moves(i))
        hold_off_boundary(i);
    return largest_way(first, last);
  });
  max_displacement_ = std::sqrt(square);
  std::swap(nodes_.x, next_);
}

void Level::hold_off_boundary(std::int64_t i) const {
  const Point<2> from = nodes_.position(i), to = point_at<2>(next_, i);
  if (near_edges_.stays_clear(i, from, to, kBoundaryClearance * nodes_.d(i))) return;
  const ClearPosition kept = clear_position(map_, near_edges_.edges_of(i), from, to, nodes_.d(i));
  for (int k = 0; k < 2; ++k) {
    if (kept.position[k] != to[k])
      nodes_.v[k](i) = (kept.position[k] - from[k]) / settings_.motion.dt;
    next_[k](i) = kept.position[k];
  }
}

// The square of the longest way of these nodes since the lists were made, in units of d.
double Level::largest_way(std::int64_t first, std::int64_t last) const {
  const double *const x = next_[0].data(), *const y = next_[1].data(), *const d = nodes_.d.data(),
                      *const listed_x = listed_[0].data(), *const listed_y = listed_[1].data();
  double largest = 0;
#pragma omp simd reduction(max : largest)
  for (std::int64_t i = first; i < last; ++i) {
    const double dx = x[i] - listed_x[i], dy = y[i] - listed_y[i];
    largest = std::max(largest, (dx * dx + dy * dy) / (d[i] * d[i]));
  }
  return largest;
}

}  // namespace pnpbs
