// SPDX-License-Identifier: BSD-3-Clause
#include "core/level.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <unordered_map>

#include "core/initial_fill.hpp"
#include "forces/population.hpp"
#include "geometry/keep_off.hpp"
#include "geometry/segments.hpp"
#include "stars/sweep.hpp"

namespace pnpbs {

Level::Level(std::shared_ptr<const PlaneDomain> domain, std::shared_ptr<const Spacing<2>> spacing,
             const Settings& settings, Timers& timers)
    : domain_(std::move(domain)),
      spacing_(std::move(spacing)),
      settings_(settings),
      timers_(timers) {}

SpacingEvaluator Level::evaluator() const {
  return [this](std::int64_t n, const Point<2>* x, double* d) {
    evaluate_spacing<2>(*spacing_, domain_->area(), n, x, d);
  };
}

// ------------------------------------------------------------------ making the level -----------

void Level::lay_boundary_and_tree() {
  {
    const PhaseTimer timer(timers_, Phase::boundary);
    boundary_ = lay_boundary(*domain_, evaluator(), settings_.max_nodes);
    // Fixed nodes off the curves act as edges of no length: inner nodes keep off them, too.
    for (std::size_t f = static_cast<std::size_t>(boundary_.first_fixed);
         f < boundary_.nodes.size(); ++f) {
      const std::int32_t node = static_cast<std::int32_t>(f);
      boundary_.edges.push_back({node, node, boundary_.nodes[f].tag, true, true});
    }
    fans_.build(boundary_);
    boundary_ids_.assign(boundary_.nodes.size(), -1);
  }
  const PhaseTimer timer(timers_, Phase::tree);
  map_.build(domain_->bounds(), boundary_, evaluator(), settings_.max_nodes);
  near_edges_.prepare(map_, widest_radius());
  buckets_.reset();
}

void Level::change_settings(const Settings& settings) {
  const double before = widest_radius();
  settings_ = settings;
  if (widest_radius() == before) return;
  near_edges_.prepare(map_, widest_radius());
  lists_valid_ = false;
}

double Level::widest_radius() const {
  return std::max(settings_.list_radius, settings_.adjacency_radius);
}

void Level::keep_boundary_ids(const Level& earlier) {
  std::unordered_map<std::uint64_t, std::vector<std::int64_t>> by_place;
  const auto key = [](const Point<2>& x) {
    return std::hash<double>{}(x[0]) * 31 + std::hash<double>{}(x[1]);
  };
  const Nodes<2>& old = earlier.nodes_;
  for (std::int64_t i = 0; i < old.count; ++i)
    if (!old.moves(i)) by_place[key(old.position(i))].push_back(i);
  for (std::size_t b = 0; b < boundary_.nodes.size(); ++b) {
    const auto found = by_place.find(key(boundary_.nodes[b].position));
    if (found == by_place.end()) continue;
    for (std::int64_t i : found->second)
      if (old.position(i) == boundary_.nodes[b].position) boundary_ids_[b] = old.id(i);
  }
  next_id_ = std::max(next_id_, earlier.next_id_);
}

void Level::fill() {
  const PhaseTimer timer(timers_, Phase::fill);
  std::vector<GivenNode> inner;
  for (const Point<2>& x : hexagonal_fill(map_, domain_->bounds())) inner.push_back({x, -1});
  number_and_store(std::move(inner));
}

std::int64_t Level::take(const std::vector<GivenNode>& given) {
  const PhaseTimer timer(timers_, Phase::fill);
  std::vector<GivenNode> inner;
  for (const GivenNode& node : given)
    if (fits(node.position, map_.leaf_spacing(map_.tree().leaf_at(node.position))))
      inner.push_back(node);
  const std::int64_t left_out = static_cast<std::int64_t>(given.size() - inner.size());
  number_and_store(std::move(inner));
  return left_out;
}

// New ids go by bucket in Morton order, boundary nodes first, so that the order of ids is nearly
// the order in memory.
void Level::number_and_store(std::vector<GivenNode> inner) {
  struct Numbered {
    std::int32_t leaf;
    std::int32_t boundary_node;  // -1 inner
    std::int64_t order;
  };
  const auto inner_count = static_cast<std::int64_t>(inner.size());
  std::vector<Numbered> all;
  for (std::int32_t b = 0; b < static_cast<std::int32_t>(boundary_.nodes.size()); ++b)
    all.push_back({map_.tree().leaf_at(boundary_.nodes[static_cast<std::size_t>(b)].position), b,
                   b - boundary_nodes()});
  for (std::int64_t i = 0; i < inner_count; ++i) {
    const GivenNode& node = inner[static_cast<std::size_t>(i)];
    all.push_back({map_.tree().leaf_at(node.position), -1, i});
    next_id_ = std::max(next_id_, node.id + 1);
  }
  std::sort(all.begin(), all.end(), [](const Numbered& a, const Numbered& b) {
    return std::tie(a.leaf, a.order) < std::tie(b.leaf, b.order);
  });
  nodes_.count = 0;
  nodes_.reserve(static_cast<std::int64_t>(all.size() + all.size() / 16) + 64);
  for (const Numbered& entry : all) {
    if (entry.boundary_node >= 0) {
      const std::size_t b = static_cast<std::size_t>(entry.boundary_node);
      if (boundary_ids_[b] < 0) boundary_ids_[b] = next_id_++;
      nodes_.append(boundary_.nodes[b].position, 1, boundary_ids_[b], boundary_.nodes[b].tag,
                    entry.boundary_node);
    } else {
      const GivenNode& node = inner[static_cast<std::size_t>(entry.order)];
      nodes_.append(node.position, 1, node.id >= 0 ? node.id : next_id_++, 0, -1);
    }
  }
  refresh_spacing();
}

std::vector<GivenNode> Level::inner_nodes() const {
  std::vector<GivenNode> inner;
  for (std::int64_t i = 0; i < nodes_.count; ++i)
    if (nodes_.moves(i)) inner.push_back({nodes_.position(i), nodes_.id(i)});
  return inner;
}

bool Level::fits(const Point<2>& x, double d) const {
  const Box<2>& box = domain_->bounds();
  for (int k = 0; k < 2; ++k)
    if (!(x[k] > box.low[k] && x[k] < box.high[k])) return false;
  return map_.inside(x) && map_.clearance(x, kBoundaryClearance * d) >= kBoundaryClearance * d;
}

// ------------------------------------------------------------------ the time loop --------------

// A pair that was not listed, farther apart than radius times its desired distance, must not have
// come within the range of the force: each node may travel half of the difference. d does not
// change between rebuilds.
bool Level::lists_may_miss_a_pair() const {
  return !lists_valid_ || travelled_ > 0.5 * (lists_.radius() - settings_.force_range());
}

void Level::rebuild_lists(double radius) {
  const PhaseTimer timer(timers_, Phase::lists);
  buckets_.sort(map_.tree(), nodes_, widest_radius());
  near_edges_.build(nodes_, buckets_, map_);
  lists_.build(nodes_, buckets_, radius, [this](std::int64_t i, std::int64_t j) {
    return near_edges_.visible(nodes_, map_, fans_, i, j);
  });
  reserve_field<2>(next_, "pnpbs::Level::next", nodes_.capacity());
  reserve_field<2>(listed_, "pnpbs::Level::listed", nodes_.capacity());
  set_padding();
  for_each("pnpbs::Level::listed", nodes_.count, [this](std::int64_t i) {
    for (int k = 0; k < 2; ++k) listed_[k](i) = nodes_.x[k](i);
  });
  travelled_ = 0;
  lists_valid_ = true;
  ++rebuilds_;
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

void Level::move() {
  const PhaseTimer timer(timers_, Phase::motion);
  if (settings_.cubic_law)
    move_by(CubicLaw{}, false);
  else
    move_by(LinearPush{1, settings_.rest_length}, false);
  take_next_positions();
}

void Level::finish_by_runge_kutta() {
  const PhaseTimer timer(timers_, Phase::motion);
  if (settings_.cubic_law)
    move_by(CubicLaw{}, true);
  else
    move_by(LinearPush{1, settings_.rest_length}, true);
  take_next_positions();
}

// Inner nodes near the boundary are held off it; then the new positions become the positions.
void Level::take_next_positions() {
  travelled_ = largest_of("pnpbs::Level::take_next", nodes_.count, 0.0, [this](std::int64_t i) {
    if (near_edges_.any(i) && nodes_.moves(i)) {
      const std::span<const std::int32_t> edges = near_edges_.edges_of(i);
      const Point<2> from = nodes_.position(i), to{next_[0](i), next_[1](i)};
      const KeptOff kept = keep_off(map_, edges, from, to, nodes_.d(i));
      for (int k = 0; k < 2; ++k) {
        if (kept.position[k] != to[k])
          nodes_.v[k](i) = (kept.position[k] - from[k]) / settings_.motion.dt;
        next_[k](i) = kept.position[k];
      }
    }
    const double dx = next_[0](i) - listed_[0](i), dy = next_[1](i) - listed_[1](i);
    return std::sqrt(dx * dx + dy * dy) / nodes_.d(i);
  });
  std::swap(nodes_.x, next_);
}

// ------------------------------------------------------------------ events ---------------------

void Level::refresh_spacing() {
  const PhaseTimer timer(timers_, Phase::spacing);
  constexpr std::int64_t kBatch = 1 << 16;  // bounds the memory for the points handed out
  const auto batch = static_cast<std::size_t>(std::min(kBatch, nodes_.count));
  std::vector<Point<2>> x(batch);
  std::vector<double> d(batch);  // the nodes' own d stays as it is if the callback fails
  for (std::int64_t first = 0; first < nodes_.count; first += kBatch) {
    const std::int64_t n = std::min(kBatch, nodes_.count - first);
    for_each("pnpbs::Level::refresh_spacing", n,
             [&](std::int64_t i) { x[static_cast<std::size_t>(i)] = nodes_.position(first + i); });
    evaluate_spacing<2>(*spacing_, domain_->area(), n, x.data(), d.data());
    std::copy(d.begin(), d.begin() + n, nodes_.d.data() + first);
  }
  lists_valid_ = false;
}

bool Level::has_no_room(std::int64_t i) const {
  double gap = kFarAway;
  for (std::int32_t e : near_edges_.edges_of(i))
    gap = std::min(gap,
                   distance_to_segment(map_.edge_begin(e), map_.edge_end(e), nodes_.position(i)));
  return gap < kLeastClearance * nodes_.d(i);
}

PopulationCounts Level::adjust_population() {
  rebuild_lists();
  const PhaseTimer timer(timers_, Phase::population);
  PopulationChange<2> change = choose_population_change<2>(
      nodes_, lists_, settings_.population, [this](std::int64_t i) { return has_no_room(i); },
      [this](const Point<2>& x, double d) { return fits(x, d); });

  if (!change.deleted.empty()) {
    View<std::int32_t> stay = make_view<std::int32_t>("pnpbs::Level::stay", nodes_.count);
    std::int64_t kept = 0;
    std::size_t next = 0;
    for (std::int32_t i = 0; i < nodes_.count; ++i) {
      if (next < change.deleted.size() && change.deleted[next] == i)
        ++next;
      else
        stay(kept++) = i;
    }
    nodes_.permute(stay, kept);
  }
  // Ids by bucket in Morton order, then by parent: no order of threads or ranks comes in.
  const BackgroundTree<2>& tree = map_.tree();
  std::sort(change.born.begin(), change.born.end(), [&](const Birth<2>& a, const Birth<2>& b) {
    const std::int32_t leaf_a = tree.leaf_at(a.position), leaf_b = tree.leaf_at(b.position);
    return std::tie(leaf_a, a.parent) < std::tie(leaf_b, b.parent);
  });
  for (const Birth<2>& birth : change.born)
    nodes_.append(birth.position, birth.d, next_id_++, 0, -1);
  if (!change.deleted.empty() || !change.born.empty()) lists_valid_ = false;
  return {static_cast<std::int64_t>(change.born.size()),
          static_cast<std::int64_t>(change.deleted.size())};
}

Speeds Level::speeds() const {
  const auto scaled = [this](std::int64_t i) {
    return std::sqrt(nodes_.v[0](i) * nodes_.v[0](i) + nodes_.v[1](i) * nodes_.v[1](i)) /
           nodes_.d(i);
  };
  Speeds speeds;
  speeds.largest = largest_of("pnpbs::Level::largest_speed", nodes_.count, 0.0, scaled);
  const std::uint64_t sum = sum_of("pnpbs::Level::mean_speed", nodes_.count,
                                   [&](std::int64_t i) { return fixed_point(scaled(i)); });
  const std::int64_t moving = std::max<std::int64_t>(1, nodes_.count - boundary_nodes());
  speeds.mean = from_fixed_point(sum) / static_cast<double>(moving);
  return speeds;
}

void Level::renew_stars() {
  const PhaseTimer timer(timers_, Phase::stars);
  stars_.build({nodes_, map_, fans_, buckets_, lists_, near_edges_});
}

// In blocks of a few sweeps, within which the stars stay as they are.
void Level::sweep(std::int64_t times) {
  constexpr std::int64_t kBlock = 5;
  for (std::int64_t done = 0; done < times; done += kBlock) {
    rebuild_lists();
    renew_stars();
    const PhaseTimer timer(timers_, Phase::sweeps);
    const View<char> allowed = make_view<char>("pnpbs::Level::allowed", nodes_.count);
    for (std::int64_t s = 0; s < std::min(kBlock, times - done); ++s)
      pnpbs::sweep(nodes_, stars_, near_edges_, map_, settings_.sweep, next_, allowed);
    lists_valid_ = false;
  }
}

}  // namespace pnpbs
