// SPDX-License-Identifier: BSD-3-Clause
#include "results/results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/kokkos_runtime.hpp"
#include "level/finding_stars.hpp"
#include "level/lists_and_stars.hpp"
#include "level/node_digest.hpp"
#include "level/plane/closed_sphere.hpp"
#include "level/plane/elements_on_boundary.hpp"
#include "level/reach.hpp"
#include "level/volume/settled_elements.hpp"
#include "quality/measured_nodes.hpp"
#include "results/cracks.hpp"
#include "results/element_angles.hpp"
#include "results/mid_nodes.hpp"
#include "results/periodic_cut.hpp"

namespace pnpbs {

namespace {

// Appends the owned nodes, or the ghosts, in the order of ids. Where a rank has nearly all nodes
// the ids are nearly dense, and no sort is needed.
template <int Dim>
void append_by_id(const Nodes<Dim>& nodes, bool owned, std::vector<std::int32_t>& order) {
  constexpr std::int64_t kDense = 4;  // ids per node up to which no sort is done
  const auto first = static_cast<std::ptrdiff_t>(order.size());
  std::int64_t min = std::numeric_limits<std::int64_t>::max(), max = -1;
  for (std::int32_t i = 0; i < nodes.count; ++i) {
    if ((nodes.owned(i) != 0) != owned) continue;
    order.push_back(i);
    min = std::min(min, nodes.id(i));
    max = std::max(max, nodes.id(i));
  }
  const auto begin = order.begin() + first;
  if (begin == order.end()) return;
  bool sort = max - min >= kDense * (order.end() - begin);
  if (!sort) {
    std::vector<std::int32_t> node_of(static_cast<std::size_t>(max - min + 1), -1);
    for (auto i = begin; i != order.end(); ++i) {
      std::int32_t& node = node_of[static_cast<std::size_t>(nodes.id(*i) - min)];
      sort = sort || node >= 0;  // two ranks assigned the same id
      node = *i;
    }
    if (!sort)
      std::copy_if(node_of.begin(), node_of.end(), begin, [](std::int32_t i) { return i >= 0; });
  }
  if (sort)
    std::sort(begin, order.end(),
              [&](std::int32_t a, std::int32_t b) { return nodes.id(a) < nodes.id(b); });
}

}  // namespace

std::int64_t NodalResults::global_count() const {
  return static_cast<std::int64_t>(comm_->allreduce_sum(static_cast<std::uint64_t>(count())));
}

template <int Dim>
std::int64_t Results<Dim>::count() const {
  if (!level_) return 0;
  return order_stamp_ == level_->stamp() ? owned_in_order_ : level_->owned_count();
}

template <int Dim>
void Results<Dim>::require_nodes() const {
  require_kokkos();
  if (!level_) throw Error(ErrorKind::state, "the placement has no nodes yet: call run first");
}

template <int Dim>
void Results<Dim>::prepare_order() {
  require_nodes();
  if (order_stamp_ == level_->stamp()) return;
  const Nodes<Dim>& nodes = level_->nodes;
  by_id_.clear();
  by_id_.reserve(static_cast<std::size_t>(nodes.count));
  append_by_id(nodes, true, by_id_);
  owned_in_order_ = std::ssize(by_id_);
  append_by_id(nodes, false, by_id_);
  place_.resize(by_id_.size());
  for (std::size_t p = 0; p < by_id_.size(); ++p)
    place_[static_cast<std::size_t>(by_id_[p])] = static_cast<std::int32_t>(p);
  order_stamp_ = level_->stamp();
}

template <int Dim>
void Results<Dim>::prepare_lists() {
  require_nodes();
  if (lists_stamp_ == level_->stamp()) return;
  pnpbs::prepare_lists(*level_);
  collective_try(*comm_, [this] { prepare_order(); });
  lists_stamp_ = level_->stamp();
}

template <int Dim>
void Results<Dim>::prepare_stars() {
  require_nodes();
  if (stars_stamp_ == level_->stamp()) return;
  if (restore_stars(*level_)) {
    collective_try(*comm_, [this] { prepare_order(); });
  } else {
    prepare_lists();
    if (!level_->distributed()) rebuild_stars(*level_);
  }
  settle_elements(*level_, kThoroughRounds);
  collective_try(*comm_, [this] { close_sphere(*level_); });
  stars_stamp_ = level_->stamp();
}

template <int Dim>
void Results<Dim>::agree_on_derived() noexcept {
  if (!level_ || !level_->distributed()) return;
  std::uint64_t derived = mixed(static_cast<std::uint64_t>(level_->ghosts.hops()));
  derived = mixed(derived ^ static_cast<std::uint64_t>(level_->tree->hops()));
  for (const bool is_there :
       {level_->ghosts.are_exact(level_->nodes, kStarHops), lists_stamp_ == stamp(),
        stars_stamp_ == stamp(), exchange_stamp_ == stamp(), quality_stamp_ == stamp(),
        mid_nodes_stamp_ == stamp(), cracks_stamp_ == stamp()})
    derived = mixed(derived ^ std::uint64_t{is_there});
  bool agreed = false;
  try {
    agreed = comm_->same_on_all(derived);
  } catch (...) {  // the ranks can no longer communicate
  }
  if (!agreed) level_->forget_derived();
}

template <int Dim>
const MidNodes& Results<Dim>::mid_nodes() {
  prepare_stars();
  if (mid_nodes_stamp_ == level_->stamp()) return *mid_nodes_;
  mid_nodes_ = std::make_shared<const MidNodes>(make_mid_nodes(*this));
  mid_nodes_stamp_ = level_->stamp();
  return *mid_nodes_;
}

template <int Dim>
const Cracks<Dim>& Results<Dim>::cracks() {
  prepare_stars();
  const bool is_known = cracks_stamp_ == level_->stamp();
  if (comm_->allreduce_sum(std::uint64_t{!is_known}) == 0) return *cracks_;
  cracks_ = std::make_shared<const Cracks<Dim>>(
      level_->nodes.cell.any() ? make_periodic_cut(*this) : make_cracks(*this, crack_tags_));
  cracks_stamp_ = level_->stamp();
  return *cracks_;
}

template <int Dim>
std::shared_ptr<const ExchangePattern> Results<Dim>::exchange_pattern() {
  require_nodes();
  if (level_->distributed())
    prepare_lists();
  else
    prepare_order();  // a single rank has no ghosts
  if (exchange_stamp_ == level_->stamp()) return exchange_pattern_;
  const Nodes<Dim>& nodes = level_->nodes;
  const std::int64_t owned = count();
  std::vector<std::int64_t> ids;
  std::vector<std::int32_t> owners;
  collective_try(*comm_, [&] {
    ids.reserve(static_cast<std::size_t>(nodes.count));
    for (std::int64_t place = 0; place < nodes.count; ++place) {
      ids.push_back(nodes.cell.home_id(nodes.id(node_at(place))));
      if (place >= owned) owners.push_back(level_->tree->owner_at(nodes.position(node_at(place))));
    }
  });
  exchange_pattern_ =
      std::make_shared<const ExchangePattern>(make_exchange_pattern(*comm_, owned, ids, owners));
  exchange_stamp_ = level_->stamp();
  return exchange_pattern_;
}

std::int64_t NodalResults::nodes_on_ranks_before() const { return comm_->exclusive_scan(count()); }

template <int Dim>
NodeColumns Results<Dim>::nodes() const {
  if (!level_) return {};
  const Nodes<Dim>& nodes = level_->nodes;
  NodeColumns columns{nodes.count,       {}, nodes.d.view(), numbers(), nodes.tag.view(),
                      nodes.owned.view()};
  for (std::size_t k = 0; k < Dim; ++k) columns.x[k] = nodes.x[k].view();
  if (!embedding().is_sphere()) return columns;
  put_on_sphere();
  for (std::size_t k = 0; k < 3; ++k) columns.x[k] = on_sphere_[k];
  columns.d = spacing_on_sphere_;
  return columns;
}

// Returns the ids of the nodes as the user knows them, which are those of their nodes for images.
template <int Dim>
View<const std::int64_t> Results<Dim>::numbers() const {
  const Nodes<Dim>& nodes = level_->nodes;
  if (!nodes.cell.any()) return nodes.id.view();
  if (numbers_stamp_ != level_->stamp()) {
    numbers_ = make_view<std::int64_t>("pnpbs::Results::numbers", nodes.count);
    for_each("pnpbs::Results::numbers", nodes.count,
             [&](std::int64_t i) { numbers_(i) = nodes.number(i); });
    numbers_stamp_ = level_->stamp();
  }
  return numbers_;
}

template <int Dim>
void Results<Dim>::put_on_sphere() const {
  if (on_sphere_stamp_ == level_->stamp()) return;
  const std::int64_t n = level_->nodes.count;
  for (View<double>& x : on_sphere_) x = make_view<double>("pnpbs::Results::on_sphere", n);
  spacing_on_sphere_ = make_view<double>("pnpbs::Results::spacing_on_sphere", n);
  for_each("pnpbs::Results::put_on_sphere", n, [this](std::int64_t i) {
    const Point<3> x = point_in_space(i);
    for (std::size_t k = 0; k < 3; ++k) on_sphere_[k](i) = x[k];
    spacing_on_sphere_(i) = spacing_at(i);
  });
  on_sphere_stamp_ = level_->stamp();
}

template <int Dim>
Point<3> Results<Dim>::point_in_space(std::int64_t node) const {
  return embedding().in_space(level_->nodes.position(node));
}

template <int Dim>
double Results<Dim>::spacing_at(std::int64_t node) const {
  return embedding().measured_length(level_->nodes.position(node), level_->nodes.d(node));
}

// ------------------------------------------------------------------ figures --------------------

template <int Dim>
LevelFigures Results<Dim>::level_figures() const {
  if (!level_) return {};
  return {level_->ghosts.neighbour_ranks(),
          level_->ghosts.update_bytes(),
          level_->neighbourhood.owned_work(),
          level_->neighbourhood.rebuilds(),
          level_->rebalances,
          level_->left_out};
}

template <int Dim>
std::int64_t Results<Dim>::boundary_nodes() const {
  return level_ ? pnpbs::boundary_nodes(*level_) : 0;
}

template <int Dim>
NearestNeighbourError Results<Dim>::spacing_error() {
  prepare_lists();
  const Nodes<Dim>& nodes = level_->nodes;
  const MeasuredNodes<Dim> measured{nodes, embedding()};
  const AdjacencyList<Dim>& lists = level_->lists();
  // Nodes without listed neighbours count with the radius of the lists.
  View<double> ratio;
  collective_try(*comm_,
                 [&] { ratio = make_view<double>("pnpbs::spacing_error::ratio", nodes.count); });
  for_each("pnpbs::spacing_error::ratio", nodes.count, [&](std::int64_t i) {
    if (!nodes.owned(i)) return;
    double nearest = lists.radius() * measured.d(i);
    lists.for_neighbours(
        i, [&](std::int64_t j) { nearest = std::min(nearest, measured.distance_between(i, j)); });
    ratio(i) = nearest / measured.d(i);
  });
  const double n = static_cast<double>(global_count());
  const auto mean_of = [&](const auto& value) {
    const FixedPointSum sum =
        fixed_point_sum_of("pnpbs::spacing_error", nodes.count,
                           [&](std::int64_t i) { return nodes.owned(i) ? value(i) : 0.0; });
    return comm_->allreduce_sum(sum).value() / n;
  };
  NearestNeighbourError error;
  error.mean = mean_of(ratio);
  error.deviation = std::sqrt(
      mean_of([&](std::int64_t i) { return (ratio(i) - error.mean) * (ratio(i) - error.mean); }));
  error.min = -comm_->allreduce_max(
      max_of("pnpbs::spacing_error::least", nodes.count, -kFarAway,
             [&](std::int64_t i) { return nodes.owned(i) ? -ratio(i) : -kFarAway; }));
  return error;
}

template <int Dim>
const ElementQuality& Results<Dim>::element_quality() {
  prepare_stars();
  if (quality_stamp_ == level_->stamp()) return quality_;
  quality_ = measure_elements<Dim>(
      *comm_, {level_->nodes, embedding()}, level_->stars,
      [this](const View<double>& values) { level_->ghosts.fill(*comm_, values); });
  quality_.simplex.on_boundary = elements_on_boundary(*level_);
  quality_.simplex.min_angle_elsewhere = quality_.simplex.min_angle;
  if constexpr (Dim == 3) {
    if (level_->geometry.kind() != GeometryKind::surface) {
      const LeastAngles least = least_angles(*level_, quality_.simplex.min_angle);
      quality_.simplex.min_angle_at_sharp_edges = least.at_sharp_edges;
      quality_.simplex.min_angle_elsewhere = least.elsewhere;
    }
  }
  quality_stamp_ = level_->stamp();
  return quality_;
}

template <int Dim>
std::uint64_t Results<Dim>::hash() const {
  if (!level_) return 0;
  return sum_of_node_hashes(*level_, [&](std::int64_t i, std::uint64_t h) {
    return mixed(h ^ static_cast<std::uint64_t>(static_cast<std::uint32_t>(level_->nodes.tag(i))));
  });
}

template class Results<2>;
template class Results<3>;

}  // namespace pnpbs
