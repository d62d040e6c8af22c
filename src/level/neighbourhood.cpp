// SPDX-License-Identifier: BSD-3-Clause
#include "level/neighbourhood.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dynamics/bubble_force.hpp"
#include "level/reach.hpp"

namespace pnpbs {

namespace {

// Cost of a node in addition to its listed pairs. [pairs]
constexpr std::int64_t kNodeWork = 8;

}  // namespace

template <int Dim>
void Neighbourhood<Dim>::adopt(const LevelTree<Dim>& tree,
                               typename NearBoundary<Dim>::NearLeaves near_leaves) {
  near_boundary_.adopt(std::move(near_leaves));
  arrangement_ = -1;
  if (prepared_for_ == &tree) return;
  prepared_for_ = &tree;
  buckets_.reset(tree.links());
}

template <int Dim>
void Neighbourhood<Dim>::forget(const LevelTree<Dim>& tree, const Nodes<Dim>& nodes,
                                const Figures& figures) noexcept {
  prepared_for_ = nullptr;
  buckets_.reset(tree.links());
  listed_ = {};
  release_lists();
  rebuilds_ = figures.rebuilds;
  owned_work_ = figures.owned_work;
  work_counted_ = figures.work_is_current ? nodes.references() : -1;
}

template <int Dim>
void Neighbourhood<Dim>::release_lists() noexcept {
  lists_ = {};
  for_steps_ = false;
  arrangement_ = -1;
}

template <int Dim>
bool Neighbourhood<Dim>::sort_nodes(Nodes<Dim>& nodes, const LevelTree<Dim>& tree,
                                    const Settings& settings) {
  return buckets_.sort(tree.tree(), nodes, widest_radius(settings));
}

template <int Dim>
void Neighbourhood<Dim>::rebuild_for_steps(Nodes<Dim>& nodes, const LevelGeometry<Dim>& geometry,
                                           const LevelTree<Dim>& tree, const Settings& settings,
                                           ListsOf listed) {
  rebuild(nodes, geometry, tree, settings.list_radius, nodes.reference, listed);
  reserve_field<Dim>(listed_, "pnpbs::Neighbourhood::listed", nodes.capacity());
  for_each("pnpbs::Neighbourhood::listed", nodes.count, [&](std::int64_t i) {
    for (int k = 0; k < Dim; ++k) listed_[k](i) = nodes.x[k](i);
  });
  max_displacement_ = 0;
  for_steps_ = true;
}

template <int Dim>
void Neighbourhood<Dim>::add_lists(const Nodes<Dim>& nodes, const LevelGeometry<Dim>& geometry,
                                   const LevelTree<Dim>& tree,
                                   const std::vector<std::int32_t>& more) {
  if constexpr (Dim == 3) near_boundary_.add(nodes, buckets_, tree.map(), geometry, more);
  lists_.add(nodes, buckets_, near_boundary_.visibility(nodes, tree.map(), geometry), more);
}

template <int Dim>
void Neighbourhood<Dim>::rebuild_here(Nodes<Dim>& nodes, const LevelGeometry<Dim>& geometry,
                                      const LevelTree<Dim>& tree, double radius, ListsOf listed) {
  listed_ = {};
  nodes.release_spare();
  // Near facets are found from the reference positions, even if nodes have moved since.
  rebuild(nodes, geometry, tree, radius, nodes.referenced_here() ? nodes.reference : nodes.x,
          listed);
}

template <int Dim>
void Neighbourhood<Dim>::rebuild(Nodes<Dim>& nodes, const LevelGeometry<Dim>& geometry,
                                 const LevelTree<Dim>& tree, double radius,
                                 const Field<Dim>& seen_from, ListsOf listed) {
  for_steps_ = false;
  arrangement_ = -1;
  const SizedTree<Dim>& map = tree.map();
  if constexpr (Dim == 3)
    near_boundary_.build(nodes, seen_from, buckets_, map, geometry, listed);
  else
    near_boundary_.build(nodes, seen_from, buckets_, map, geometry);
  lists_.build(nodes, buckets_, radius, near_boundary_.visibility(nodes, map, geometry), listed);
  listed_nodes_ = listed;
  nodes.set_padding();
  ++rebuilds_;
  const std::int64_t owned = owned_count(nodes);
  nodes_listed_ = {listed == ListsOf::all_nodes ? nodes.count : owned, owned};
  arrangement_ = nodes.arrangement();
  positions_ = nodes.positions();
  references_ = nodes.references();
  if (work_counted_ != nodes.references()) count_work(nodes);
}

// A pair that is not listed is farther apart than the list radius times its desired distance. It
// must not come within the range of the force, so each node may move by half of the difference. A
// scheme with stages evaluates forces one move ahead. d does not change between rebuilds.
template <int Dim>
bool Neighbourhood<Dim>::needs_rebuild(const Nodes<Dim>& nodes, const Settings& settings) const {
  if (!for_steps_ || arrangement_ != nodes.arrangement() || references_ != nodes.references() ||
      (ghosts_move(settings) && listed_nodes_ == ListsOf::owned_nodes))
    return true;
  const double ahead = settings.predictor_corrector ? settings.motion.max_move : 0;
  return max_displacement_ + ahead > 0.5 * (lists_.radius() - settings.force_range());
}

template <int Dim>
double Neighbourhood<Dim>::squared_displacement(const Nodes<Dim>& nodes, const Field<Dim>& at,
                                                std::int64_t first, std::int64_t last) const {
  const Positions<Dim> x = positions_of<Dim>(at), listed = positions_of<Dim>(listed_);
  const double* const d = nodes.d.data();
  double max = 0;
#pragma omp simd reduction(max : max)
  for (std::int64_t i = first; i < last; ++i) {
    double square = 0;
    for (int k = 0; k < Dim; ++k) square += (x[k][i] - listed[k][i]) * (x[k][i] - listed[k][i]);
    max = std::max(max, square / (d[i] * d[i]));
  }
  return max;
}

template <int Dim>
void Neighbourhood<Dim>::measure_displacement(const Nodes<Dim>& nodes) {
  if (!for_steps_ || arrangement_ != nodes.arrangement()) return;
  constexpr std::int64_t kChunk = 1024;
  max_displacement_ =
      std::sqrt(max_of("pnpbs::Neighbourhood::measure_displacement",
                       (nodes.count + kChunk - 1) / kChunk, 0.0, [&](std::int64_t c) {
                         return squared_displacement(nodes, nodes.x, c * kChunk,
                                                     std::min((c + 1) * kChunk, nodes.count));
                       }));
}

template <int Dim>
void Neighbourhood<Dim>::keep_nodes(Nodes<Dim>& nodes, const View<std::int32_t>& places,
                                    std::int64_t kept) {
  nodes.keep(places, kept);
  buckets_.keep(places, kept);
}

template <int Dim>
std::int64_t Neighbourhood<Dim>::work_of(std::int64_t i) const {
  std::int64_t pairs = 0;
  lists_.for_neighbours(i, [&](std::int64_t) { ++pairs; });
  return kNodeWork + pairs;
}

template <int Dim>
void Neighbourhood<Dim>::count_work(const Nodes<Dim>& nodes) {
  const auto none = static_cast<std::int32_t>(nodes.count);  // padding of short lists
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

template class Neighbourhood<2>;
template class Neighbourhood<3>;

}  // namespace pnpbs
