// SPDX-License-Identifier: BSD-3-Clause
#include "level/neighbourhood.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "level/reach.hpp"

namespace pnpbs {

namespace {

// What a node costs besides its listed pairs, in units of one pair.
constexpr std::int64_t kNodeWork = 8;

}  // namespace

NearEdges Neighbourhood::edges_near_leaves(const LevelTree& tree, double radius) {
  NearEdges edges;
  edges.prepare(tree.map(), *tree.links(), radius);
  return edges;
}

void Neighbourhood::adopt(const LevelTree& tree, NearEdges edges_near_leaves) {
  near_edges_ = std::move(edges_near_leaves);
  arrangement_ = -1;
  if (prepared_for_ == &tree) return;
  prepared_for_ = &tree;
  buckets_.reset(tree.links());
}

bool Neighbourhood::sort_nodes(Nodes<2>& nodes, const LevelTree& tree, const Settings& settings) {
  return buckets_.sort(tree.tree(), nodes, widest_radius(settings));
}

void Neighbourhood::rebuild_for_steps(Nodes<2>& nodes, const Ground& ground, const LevelTree& tree,
                                      const Settings& settings) {
  rebuild(nodes, ground, tree, settings.list_radius, nodes.reference);
  reserve_field<2>(listed_, "pnpbs::Neighbourhood::listed", nodes.capacity());
  for_each("pnpbs::Neighbourhood::listed", nodes.count, [&](std::int64_t i) {
    for (int k = 0; k < 2; ++k) listed_[k](i) = nodes.x[k](i);
  });
  max_displacement_ = 0;
  for_steps_ = true;
}

void Neighbourhood::rebuild_here(Nodes<2>& nodes, const Ground& ground, const LevelTree& tree,
                                 double radius) {
  listed_ = {};
  rebuild(nodes, ground, tree, radius, nodes.x);
}

void Neighbourhood::rebuild(Nodes<2>& nodes, const Ground& ground, const LevelTree& tree,
                            double radius, const Field<2>& seen_from) {
  for_steps_ = false;
  arrangement_ = -1;
  const DomainMap<2>& map = tree.map();
  near_edges_.build(nodes, seen_from, buckets_, map);
  boundary_visibility_.look(nodes, near_edges_, map, ground.sectors());
  lists_.build(
      nodes, buckets_, radius,
      VisibilityPastEdges{nodes, near_edges_, boundary_visibility_, map, ground.sectors()});
  nodes.set_padding();
  ++rebuilds_;
  arrangement_ = nodes.arrangement();
  positions_ = nodes.positions();
  references_ = nodes.references();
  if (work_counted_ != nodes.references()) count_work(nodes);
}

// A pair that was not listed, farther apart than radius times its desired distance, must not have
// come within the range of the force: each node may travel half of the difference, and a scheme
// with stages looks one move ahead. d does not change between rebuilds.
bool Neighbourhood::needs_rebuild(const Nodes<2>& nodes, const Settings& settings) const {
  if (!for_steps_ || arrangement_ != nodes.arrangement() || references_ != nodes.references())
    return true;
  const double ahead = settings.predictor_corrector ? settings.motion.max_move : 0;
  return max_displacement_ + ahead > 0.5 * (lists_.radius() - settings.force_range());
}

double Neighbourhood::squared_displacement(const Nodes<2>& nodes, const Field<2>& at,
                                           std::int64_t first, std::int64_t last) const {
  const double *const x = at[0].data(), *const y = at[1].data(), *const d = nodes.d.data(),
                      *const listed_x = listed_[0].data(), *const listed_y = listed_[1].data();
  double max = 0;
#pragma omp simd reduction(max : max)
  for (std::int64_t i = first; i < last; ++i) {
    const double dx = x[i] - listed_x[i], dy = y[i] - listed_y[i];
    max = std::max(max, (dx * dx + dy * dy) / (d[i] * d[i]));
  }
  return max;
}

void Neighbourhood::measure_displacement(const Nodes<2>& nodes) {
  if (!for_steps_ || arrangement_ != nodes.arrangement()) return;
  constexpr std::int64_t kChunk = 1024;
  max_displacement_ =
      std::sqrt(max_of("pnpbs::Neighbourhood::measure_displacement",
                       (nodes.count + kChunk - 1) / kChunk, 0.0, [&](std::int64_t c) {
                         return squared_displacement(nodes, nodes.x, c * kChunk,
                                                     std::min((c + 1) * kChunk, nodes.count));
                       }));
}

void Neighbourhood::keep_nodes(Nodes<2>& nodes, const View<std::int32_t>& places,
                               std::int64_t kept) {
  nodes.keep(places, kept);
  buckets_.keep(places, kept);
}

std::int64_t Neighbourhood::work_of(std::int64_t i) const {
  std::int64_t pairs = 0;
  lists_.for_neighbours(i, [&](std::int64_t) { ++pairs; });
  return kNodeWork + pairs;
}

void Neighbourhood::count_work(const Nodes<2>& nodes) {
  const auto none = static_cast<std::int32_t>(nodes.count);  // what short lists are filled with
  owned_work_ = static_cast<std::int64_t>(
      sum_of("pnpbs::Neighbourhood::count_work", lists_.block_count(), [&](std::int64_t b) {
        const ListBlock list = lists_.block(b);
        std::int64_t pairs[kLanes]{};
        for (std::int32_t k = 0; k < list.length; ++k)
          for (int lane = 0; lane < kLanes; ++lane)
            pairs[lane] += list.entries[k * kLanes + lane] != none;
        std::int64_t work = 0;
        for (std::int64_t i = b * kLanes; i < std::min((b + 1) * kLanes, nodes.count); ++i)
          if (nodes.owned(i)) work += kNodeWork + pairs[i % kLanes];
        return work;
      }));
  work_counted_ = nodes.references();
}

}  // namespace pnpbs
