// SPDX-License-Identifier: BSD-3-Clause
#include "core/level.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <span>
#include <tuple>

#include "core/initial_fill.hpp"
#include "core/mixed_hash.hpp"
#include "forces/population.hpp"
#include "geometry/keep_off.hpp"
#include "geometry/segments.hpp"
#include "parallel/partition.hpp"
#include "stars/sweep.hpp"

namespace pnpbs {

namespace {

// Nodes of a hexagonal lattice per d^2.
constexpr double kHexagonalDensity = 1.1547005383792515;
// d may grow by this factor above its samples in a leaf before ghosts could be missing.
constexpr double kRoomForGrowth = 1.25;

}  // namespace

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
  near_edges_.prepare(map_, edge_radius());
  buckets_.reset();
}

void Level::change_settings(const Settings& settings) {
  const double before = edge_radius();
  settings_ = settings;
  if (edge_radius() == before) return;
  near_edges_.prepare(map_, edge_radius());
  lists_valid_ = false;
}

// Between events a node may come within the clearance of edges that were this far from it.
double Level::edge_radius() const {
  const double way = settings_.motion.most * static_cast<double>(settings_.event_interval);
  return std::max(widest_radius(), kBoundaryClearance + way);
}

double Level::widest_radius() const {
  return std::max(settings_.list_radius, settings_.adjacency_radius);
}

// ------------------------------------------------------------------ ranks ----------------------

void Level::distribute() {
  if (!distributed()) return;
  const PhaseTimer timer(timers_, Phase::partition);
  const BackgroundTree<2>& tree = map_.tree();
  std::vector<double> reach;
  std::vector<std::int64_t> work;
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    const bool outside = map_.leaf_outside(leaf);
    const double side = tree.cell_side(tree.leaf_cell(leaf)), d = map_.leaf_spacing(leaf);
    reach.push_back(outside ? 0
                            : kRoomForGrowth * widest_radius() * map_.leaf_largest_spacing(leaf));
    // Nodes to be expected, in sixteenths.
    work.push_back(outside ? 0 : 1 + static_cast<std::int64_t>(16 * side * side / (d * d)));
  }
  interaction_.build(tree, reach);
  std::vector<std::int32_t> owner;
  if (comm_->rank() == 0)
    owner = partition_leaves(interaction_, work, comm_->size(), settings_.metis_seed);
  Bytes bytes(owner.size() * sizeof(std::int32_t));
  if (!bytes.empty()) std::memcpy(bytes.data(), owner.data(), bytes.size());
  comm_->broadcast(bytes, 0);
  owner.resize(bytes.size() / sizeof(std::int32_t));
  std::memcpy(owner.data(), bytes.data(), bytes.size());
  distribution_ = Distribution(&interaction_, std::move(owner), comm_->rank());
}

namespace {

// A node on its way to another rank.
struct PackedNode {
  std::int64_t id;
  double x[2], v[2], anchor[2], d;
  std::int32_t tag, boundary_node;
};

template <class Record>
void pack(Bytes& bytes, const Record& record) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof record);
  std::memcpy(bytes.data() + at, &record, sizeof record);
}

template <class Record, class Visit>
void for_records(const std::vector<Bytes>& messages, const Visit& visit) {
  for (const Bytes& bytes : messages)
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(Record)) {
      Record record;
      std::memcpy(&record, bytes.data() + at, sizeof record);
      visit(record);
    }
}

// Place of each rank among the neighbours, -1 for the others.
std::vector<int> places_of(const std::vector<int>& neighbours, int size) {
  std::vector<int> place(static_cast<std::size_t>(size), -1);
  for (std::size_t k = 0; k < neighbours.size(); ++k)
    place[static_cast<std::size_t>(neighbours[k])] = static_cast<int>(k);
  return place;
}

}  // namespace

// How many hops of the leaf graph the ghosts must reach for owned nodes to stay exact until the
// next exchange. A hop spans at least kRoomForGrowth list radii of d; what a force evaluation
// brings in comes from no farther than the range of the force and the ways of both nodes.
int Level::step_hops() const {
  const double per_step =
      settings_.evaluations_per_step() * (settings_.force_range() + 2 * settings_.motion.most);
  const double needed = static_cast<double>(settings_.exchange_interval) * per_step;
  const int hops =
      1 + static_cast<int>(std::ceil(needed / (kRoomForGrowth * settings_.list_radius)));
  return std::max(0, hops - static_cast<int>(settings_.halo_deficit));
}

void Level::exchange(int hops) {
  ++version_;
  if (!distributed()) return;
  const PhaseTimer timer(timers_, Phase::exchange);
  const BackgroundTree<2>& tree = map_.tree();
  const Halo& halo = distribution_.halo(hops);
  const std::vector<int> place = places_of(halo.neighbours(), comm_->size());
  std::vector<Bytes> outgoing(halo.neighbours().size());
  View<std::int32_t> stay = make_view<std::int32_t>("pnpbs::Level::stay", nodes_.count);
  std::int64_t kept = 0;
  for (std::int64_t i = 0; i < nodes_.count; ++i) {
    if (!nodes_.owned(i)) continue;
    const std::int32_t leaf = tree.leaf_at(nodes_.position(i));
    const PackedNode packed{nodes_.id(i),
                            {nodes_.x[0](i), nodes_.x[1](i)},
                            {nodes_.v[0](i), nodes_.v[1](i)},
                            {nodes_.anchor[0](i), nodes_.anchor[1](i)},
                            nodes_.d(i),
                            nodes_.tag(i),
                            nodes_.boundary_node(i)};
    halo.for_ranks(leaf, [&](int r) {
      if (r == comm_->rank())
        stay(kept++) = static_cast<std::int32_t>(i);
      else if (place[static_cast<std::size_t>(r)] >= 0)
        pack(outgoing[static_cast<std::size_t>(place[static_cast<std::size_t>(r)])], packed);
    });
    nodes_.owned(i) = distribution_.owns(leaf);
  }
  nodes_.permute(stay, kept);
  const std::vector<Bytes> incoming = comm_->exchange(halo.neighbours(), outgoing);
  std::size_t arriving = 0;
  for (const Bytes& bytes : incoming) arriving += bytes.size() / sizeof(PackedNode);
  nodes_.reserve(kept + static_cast<std::int64_t>(arriving));
  for_records<PackedNode>(incoming, [&](const PackedNode& packed) {
    const Point<2> x{packed.x[0], packed.x[1]};
    nodes_.append(x, packed.d, packed.id, packed.tag, packed.boundary_node);
    const std::int64_t i = nodes_.count - 1;
    for (int k = 0; k < 2; ++k) {
      nodes_.v[k](i) = packed.v[k];
      nodes_.anchor[k](i) = packed.anchor[k];
    }
    nodes_.owned(i) = distribution_.owns(tree.leaf_at(x));
  });
  lists_valid_ = false;
}

// Every node to the rank that owns its leaf, from wherever it is.
void Level::scatter_to_owners(std::vector<GivenNode>& given) const {
  if (!distributed()) return;
  std::vector<int> others;
  for (int r = 0; r < comm_->size(); ++r)
    if (r != comm_->rank()) others.push_back(r);
  const std::vector<int> place = places_of(others, comm_->size());
  std::vector<Bytes> outgoing(others.size());
  std::vector<GivenNode> mine;
  for (const GivenNode& node : given) {
    const int owner = distribution_.owner(map_.tree().leaf_at(node.position));
    if (owner == comm_->rank())
      mine.push_back(node);
    else
      pack(outgoing[static_cast<std::size_t>(place[static_cast<std::size_t>(owner)])], node);
  }
  for_records<GivenNode>(comm_->exchange(others, outgoing),
                         [&](const GivenNode& node) { mine.push_back(node); });
  given = std::move(mine);
}

// Nodes that d asks for in each leaf. Of the leaves that the boundary crosses we know only what the
// domain's area leaves for all of them.
std::vector<double> Level::wanted_nodes() const {
  const BackgroundTree<2>& tree = map_.tree();
  const auto area_of = [&](std::int32_t leaf) {
    return std::pow(tree.cell_side(tree.leaf_cell(leaf)), 2);
  };
  double inside = 0, crossed = 0;
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf)
    if (!map_.leaf_outside(leaf)) (map_.leaf_has_edges(leaf) ? crossed : inside) += area_of(leaf);
  const double share = crossed > 0 ? std::clamp((domain_->area() - inside) / crossed, 0.0, 1.0) : 0;
  std::vector<double> wanted;
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    const double d = map_.leaf_spacing(leaf);
    const double part = map_.leaf_outside(leaf) ? 0 : map_.leaf_has_edges(leaf) ? share : 1;
    wanted.push_back(part > 0 ? part * kHexagonalDensity * area_of(leaf) / (d * d) : 0);
  }
  return wanted;
}

double Level::expected_nodes() const {
  const std::vector<double> wanted = wanted_nodes();
  return std::accumulate(wanted.begin(), wanted.end(), 0.0);
}

std::vector<GivenNode> Level::owned_nodes() const {
  std::vector<GivenNode> owned;
  for (std::int64_t i = 0; i < nodes_.count; ++i)
    if (nodes_.owned(i))
      owned.push_back({nodes_.position(i), nodes_.id(i), nodes_.moves(i), nodes_.d(i)});
  return owned;
}

std::int64_t Level::owned_count() const {
  return static_cast<std::int64_t>(sum_of("pnpbs::Level::owned_count", nodes_.count,
                                          [this](std::int64_t i) { return nodes_.owned(i); }));
}

// ------------------------------------------------------------------ nodes of a new level -------

// Boundary nodes keep their ids where they stay in place.
void Level::keep_boundary_ids(const std::vector<GivenNode>& given) {
  std::map<Point<2>, std::int64_t> id_at;
  for (const GivenNode& node : given)
    if (!node.inner) id_at[node.position] = node.id;
  for (std::size_t b = 0; b < boundary_.nodes.size() && !id_at.empty(); ++b) {
    const auto found = id_at.find(boundary_.nodes[b].position);
    if (found != id_at.end()) boundary_ids_[b] = found->second;
  }
}

void Level::fill() {
  const PhaseTimer timer(timers_, Phase::fill);
  std::vector<GivenNode> inner;
  agreed(*comm_, [&] {
    const auto own = [this](std::int32_t leaf) { return distribution_.owns(leaf); };
    for (const Point<2>& x : hexagonal_fill(map_, domain_->bounds(), own)) inner.push_back({x, -1});
  });
  number_and_store(std::move(inner));
}

namespace {

// Sum over the leaves before each in Morton order, of all ranks, plus `next_id`, which moves on by
// the sum over all.
std::vector<std::int64_t> first_ids(const Communicator& comm, std::vector<std::int64_t> new_ids,
                                    std::int64_t& next_id) {
  comm.sum(new_ids);
  for (std::int64_t& first : new_ids) {
    const std::int64_t here = first;
    first = next_id;
    next_id += here;
  }
  return new_ids;
}

}  // namespace

TakenNodes Level::take(std::vector<GivenNode> given, std::int64_t next_id) {
  const PhaseTimer timer(timers_, Phase::fill);
  next_id_ = next_id;
  scatter_to_owners(given);
  keep_boundary_ids(given);
  std::vector<GivenNode> inner;
  std::uint64_t left_out = 0;
  for (const GivenNode& node : given) {
    if (!node.inner) continue;
    if (fits(node.position, map_.leaf_spacing(map_.tree().leaf_at(node.position))))
      inner.push_back(node);
    else
      ++left_out;
  }
  const std::uint64_t before = inner.size();
  thin(inner);
  const std::uint64_t thinned = before - inner.size();
  number_and_store(std::move(inner));
  return {static_cast<std::int64_t>(comm_->sum(left_out)),
          static_cast<std::int64_t>(comm_->sum(thinned))};
}

// Where nodes are many times too dense for d, because d has grown since they were placed or because
// they were given so, contests would take long to delete them. Each then counts for the share that
// should stay, and along the Morton order of the leaves a node stays whenever the sum of the shares
// passes a whole number.
void Level::thin(std::vector<GivenNode>& inner) const {
  constexpr double kCrowded = 1.5;  // times the nodes that d asks for in a leaf, and a few
  constexpr std::int64_t kOne = std::int64_t{1} << 32;
  const BackgroundTree<2>& tree = map_.tree();
  const auto leaf_of = [&](const GivenNode& node) {
    return static_cast<std::size_t>(tree.leaf_at(node.position));
  };
  const std::vector<double> wanted = wanted_nodes();
  std::vector<double> given_in(static_cast<std::size_t>(tree.leaf_count()), 0);
  for (const GivenNode& node : inner) given_in[leaf_of(node)] += 1;
  const auto share_of = [&](const GivenNode& node) {
    const std::size_t leaf = leaf_of(node);
    const double d = map_.leaf_spacing(static_cast<std::int32_t>(leaf));
    double share = 1;
    if (node.d > 0 && d > 1.02 * node.d) share = (node.d / d) * (node.d / d);
    if (given_in[leaf] > kCrowded * wanted[leaf] + 4)
      share = std::min(share, wanted[leaf] / given_in[leaf]);
    return static_cast<std::int64_t>(share * static_cast<double>(kOne));
  };
  std::sort(inner.begin(), inner.end(), [&](const GivenNode& a, const GivenNode& b) {
    return std::make_tuple(leaf_of(a), a.position[1], a.position[0], a.id) <
           std::make_tuple(leaf_of(b), b.position[1], b.position[0], b.id);
  });
  std::vector<std::int64_t> sums(given_in.size(), 0);
  for (const GivenNode& node : inner) sums[leaf_of(node)] += share_of(node);
  std::int64_t end = 0;
  std::vector<std::int64_t> sum_before = first_ids(*comm_, std::move(sums), end);
  std::erase_if(inner, [&](const GivenNode& node) {
    std::int64_t& sum = sum_before[leaf_of(node)];
    const std::int64_t whole = sum / kOne;
    sum += share_of(node);
    return sum / kOne == whole;
  });
}

// New ids go by bucket in Morton order, boundary nodes first, then by place, so that the order of
// ids is nearly the order in memory.
void Level::number_and_store(std::vector<GivenNode> inner) {
  ++version_;
  struct Entry {
    std::int32_t leaf;
    std::int32_t boundary_node;  // the number of boundary nodes for an inner one
    Point<2> x;
    std::int64_t id;
    bool operator<(const Entry& other) const {
      return std::tie(leaf, boundary_node, x[1], x[0], id) <
             std::tie(other.leaf, other.boundary_node, other.x[1], other.x[0], other.id);
    }
  };
  const BackgroundTree<2>& tree = map_.tree();
  const std::int32_t boundary_count = static_cast<std::int32_t>(boundary_.nodes.size());
  std::vector<Entry> entries;
  for (std::int32_t b = 0; b < boundary_count; ++b) {
    const Point<2>& x = boundary_.nodes[static_cast<std::size_t>(b)].position;
    const std::int32_t leaf = tree.leaf_at(x);
    if (distribution_.owns(leaf))
      entries.push_back({leaf, b, x, boundary_ids_[static_cast<std::size_t>(b)]});
  }
  double most_id = static_cast<double>(next_id_ - 1);
  for (const GivenNode& node : inner) {
    entries.push_back({tree.leaf_at(node.position), boundary_count, node.position, node.id});
    most_id = std::max(most_id, static_cast<double>(node.id));
  }
  next_id_ = static_cast<std::int64_t>(comm_->largest(most_id)) + 1;
  std::sort(entries.begin(), entries.end());
  // Nodes in one place would never part: the first of them counts.
  entries.erase(std::unique(entries.begin(), entries.end(),
                            [](const Entry& a, const Entry& b) { return a.x == b.x; }),
                entries.end());

  std::vector<std::int64_t> new_ids(static_cast<std::size_t>(tree.leaf_count()), 0);
  for (const Entry& entry : entries) new_ids[static_cast<std::size_t>(entry.leaf)] += entry.id < 0;
  std::vector<std::int64_t> next = first_ids(*comm_, std::move(new_ids), next_id_);

  nodes_.count = 0;
  nodes_.reserve(static_cast<std::int64_t>(entries.size() + entries.size() / 64) + 64);
  for (const Entry& entry : entries) {
    const std::int64_t id = entry.id >= 0 ? entry.id : next[static_cast<std::size_t>(entry.leaf)]++;
    const bool inner_node = entry.boundary_node == boundary_count;
    nodes_.append(
        entry.x, 1, id,
        inner_node ? 0 : boundary_.nodes[static_cast<std::size_t>(entry.boundary_node)].tag,
        inner_node ? -1 : entry.boundary_node);
  }
  refresh_spacing();
  exchange(step_hops());
}

bool Level::fits(const Point<2>& x, double d) const {
  const Box<2>& box = domain_->bounds();
  for (int k = 0; k < 2; ++k)
    if (!(x[k] > box.low[k] && x[k] < box.high[k])) return false;
  return map_.inside(x) && map_.clearance(x, kBoundaryClearance * d) >= kBoundaryClearance * d;
}

// ------------------------------------------------------------------ the time loop --------------

// A pair that was not listed, farther apart than radius times its desired distance, must not have
// come within the range of the force: each node may travel half of the difference, and a scheme
// with stages looks one move ahead. d does not change between rebuilds.
bool Level::lists_may_miss_a_pair() const {
  const double ahead = settings_.predictor_corrector ? settings_.motion.most : 0;
  return !lists_valid_ || travelled_ + ahead > 0.5 * (lists_.radius() - settings_.force_range());
}

void Level::rebuild_lists() { rebuild_lists(settings_.list_radius, nodes_.anchor); }

// At the present positions; the next step makes its own again.
void Level::rebuild_lists(double radius) {
  rebuild_lists(radius, nodes_.x);
  lists_valid_ = false;
}

// An event: from now on visibility is judged from here.
void Level::drop_anchors() {
  for_each("pnpbs::Level::drop_anchors", nodes_.count, [this](std::int64_t i) {
    for (int k = 0; k < 2; ++k) nodes_.anchor[k](i) = nodes_.x[k](i);
  });
  lists_valid_ = false;
}

void Level::rebuild_lists(double radius, const Field<2>& seen_from) {
  ++version_;
  const PhaseTimer timer(timers_, Phase::lists);
  buckets_.sort(map_.tree(), nodes_, widest_radius());
  near_edges_.build(nodes_, seen_from, buckets_, map_);
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
  ++version_;
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

// By the owners; ghosts get theirs with the next exchange.
void Level::refresh_spacing() {
  ++version_;
  const PhaseTimer timer(timers_, Phase::spacing);
  agreed(*comm_, [this] {
    constexpr std::int64_t kBatch = 1 << 16;  // bounds the memory for the points handed out
    std::vector<std::int64_t> who;
    std::vector<Point<2>> x;
    std::vector<double> d;  // the nodes' own d stays as it is if the callback fails
    for (std::int64_t first = 0; first < nodes_.count; first += kBatch) {
      who.clear();
      x.clear();
      for (std::int64_t i = first; i < std::min(first + kBatch, nodes_.count); ++i) {
        if (!nodes_.owned(i)) continue;
        who.push_back(i);
        x.push_back(nodes_.position(i));
      }
      d.resize(x.size());
      evaluate_spacing<2>(*spacing_, domain_->area(), static_cast<std::int64_t>(x.size()), x.data(),
                          d.data());
      for (std::size_t k = 0; k < who.size(); ++k) nodes_.d(who[k]) = d[k];
    }
  });
  drop_anchors();
}

// Between boundary edges, or on top of another node: of two that nearly coincide the one with the
// larger id, because they push each other no more.
bool Level::has_no_room(std::int64_t i) const {
  constexpr double kNearlyCoincide = 0.2;  // in units of d
  const Point<2> x = nodes_.position(i);
  double gap = kFarAway;
  for (std::int32_t e : near_edges_.edges_of(i))
    gap = std::min(gap, distance_to_segment(map_.edge_begin(e), map_.edge_end(e), x));
  bool room = gap >= kLeastClearance * nodes_.d(i);
  lists_.for_neighbours(i, [&](std::int64_t j) {
    if (nodes_.moves(j) && nodes_.id(j) < nodes_.id(i) &&
        distance<2>(x, nodes_.position(j)) < kNearlyCoincide * nodes_.d(i))
      room = false;
  });
  return !room;
}

// In hops of the lists: a candidate is judged by its list, looks two hops far for room, and may not
// act if a stronger one is within three. A hop of the leaf graph is the longer one.
constexpr int kPopulationHops = 6;
// Five sweeps on fixed stars, each with a guard that looks at the neighbours' moves.
constexpr int kSweepHops = 12;

void Level::exchange_for_stars() { exchange(kPopulationHops); }

PopulationCounts Level::adjust_population(double refill) {
  ++version_;
  drop_anchors();
  exchange(kPopulationHops);
  PopulationChange<2> change;
  agreed(*comm_, [&] {
    rebuild_lists();
    const PhaseTimer timer(timers_, Phase::population);
    PopulationRule rule = settings_.population;
    rule.insert_below = std::max(rule.insert_below, refill);
    change = choose_population_change<2>(
        nodes_, lists_, rule, [this](std::int64_t i) { return has_no_room(i); },
        [this](const Point<2>& x, double d) { return fits(x, d); });
  });
  const PhaseTimer timer(timers_, Phase::population);
  // Births are the parent's owner's to tell; deaths every rank sees that has the node.
  PopulationCounts counts;
  std::vector<Birth<2>> born;
  for (std::size_t k = 0; k < change.born.size(); ++k)
    if (nodes_.owned(change.parents[k])) born.push_back(change.born[k]);
  for (std::int32_t i : change.deleted) counts.deleted += nodes_.owned(i);
  counts.inserted = static_cast<std::int64_t>(born.size());

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
  if (comm_->sum(born.size()) > 0) number_births(std::move(born));
  if (!change.deleted.empty() || !change.born.empty()) lists_valid_ = false;
  exchange(step_hops());
  return counts;
}

// The owner of the leaf a node is born in numbers it: ids by bucket in Morton order, then by
// parent, so that no order of threads or ranks comes in.
void Level::number_births(std::vector<Birth<2>> born) {
  const BackgroundTree<2>& tree = map_.tree();
  if (distributed()) {
    const Halo& halo = distribution_.halo(kPopulationHops);
    const std::vector<int> place = places_of(halo.neighbours(), comm_->size());
    std::vector<Bytes> outgoing(halo.neighbours().size());
    std::vector<Birth<2>> mine;
    for (const Birth<2>& birth : born) {
      const int owner = distribution_.owner(tree.leaf_at(birth.position));
      if (owner == comm_->rank())
        mine.push_back(birth);
      else
        pack(outgoing[static_cast<std::size_t>(place[static_cast<std::size_t>(owner)])], birth);
    }
    for_records<Birth<2>>(comm_->exchange(halo.neighbours(), outgoing),
                          [&](const Birth<2>& birth) { mine.push_back(birth); });
    born = std::move(mine);
  }
  std::vector<std::int64_t> new_ids(static_cast<std::size_t>(tree.leaf_count()), 0);
  for (const Birth<2>& birth : born)
    ++new_ids[static_cast<std::size_t>(tree.leaf_at(birth.position))];
  std::vector<std::int64_t> next = first_ids(*comm_, std::move(new_ids), next_id_);
  std::sort(born.begin(), born.end(),
            [](const Birth<2>& a, const Birth<2>& b) { return a.parent < b.parent; });
  for (const Birth<2>& birth : born)
    nodes_.append(birth.position, birth.d,
                  next[static_cast<std::size_t>(tree.leaf_at(birth.position))]++, 0, -1);
}

Speeds Level::speeds() const {
  const auto scaled = [this](std::int64_t i) {
    return std::sqrt(nodes_.v[0](i) * nodes_.v[0](i) + nodes_.v[1](i) * nodes_.v[1](i)) /
           nodes_.d(i);
  };
  Speeds speeds;
  speeds.largest =
      comm_->largest(largest_of("pnpbs::Level::largest_speed", nodes_.count, 0.0,
                                [&](std::int64_t i) { return nodes_.owned(i) ? scaled(i) : 0.0; }));
  const std::uint64_t sum = sum_of("pnpbs::Level::mean_speed", nodes_.count, [&](std::int64_t i) {
    return nodes_.owned(i) ? fixed_point(scaled(i)) : 0;
  });
  const auto all = static_cast<std::int64_t>(comm_->sum(static_cast<std::uint64_t>(owned_count())));
  const std::int64_t moving = std::max<std::int64_t>(1, all - boundary_nodes());
  speeds.mean = from_fixed_point(comm_->sum(sum)) / static_cast<double>(moving);
  return speeds;
}

void Level::renew_stars() {
  const PhaseTimer timer(timers_, Phase::stars);
  stars_.build({nodes_, map_, fans_, buckets_, lists_, near_edges_});
}

// In blocks of a few sweeps, within which the stars stay as they are.
void Level::sweep(std::int64_t times) {
  ++version_;
  constexpr std::int64_t kBlock = 5;
  for (std::int64_t done = 0; done < times; done += kBlock) {
    drop_anchors();
    exchange(kSweepHops);
    agreed(*comm_, [this] {
      rebuild_lists();
      renew_stars();
    });
    const PhaseTimer timer(timers_, Phase::sweeps);
    const View<char> allowed = make_view<char>("pnpbs::Level::allowed", nodes_.count);
    for (std::int64_t s = 0; s < std::min(kBlock, times - done); ++s)
      pnpbs::sweep(nodes_, stars_, near_edges_, map_, settings_.sweep, next_, allowed);
    lists_valid_ = false;
  }
}

}  // namespace pnpbs
