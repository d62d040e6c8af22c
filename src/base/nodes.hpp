// SPDX-License-Identifier: BSD-3-Clause
// The nodes of a level, with one array per attribute. Their order in memory follows the buckets and
// does not influence any result; decisions are made by id.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "base/execution.hpp"
#include "base/periodic_cell.hpp"
#include "base/rank_limit.hpp"
#include "base/types.hpp"

namespace pnpbs {

// An attribute of the nodes: an array with one value per node. Copies share the values, like copies
// of a View. Unlike a const View, a const NodeArray gives read access only.
template <class T>
class NodeArray {
 public:
  NodeArray() = default;
  NodeArray(View<T> view) : view_(std::move(view)) {}  // NOLINT: implicit conversion

  T& operator()(std::int64_t i) { return view_(i); }
  const T& operator()(std::int64_t i) const { return view_(i); }
  T* data() { return view_.data(); }
  const T* data() const { return view_.data(); }
  std::size_t extent(int direction) const { return view_.extent(direction); }

  View<T>& view() { return view_; }
  View<const T> view() const { return view_; }

 private:
  View<T> view_;
};

// A vector field on the nodes, with one array per component.
template <int Dim>
using Field = std::array<NodeArray<double>, Dim>;

template <int Dim>
Point<Dim> point_at(const Field<Dim>& x, std::int64_t i) {
  Point<Dim> p;
  for (int k = 0; k < Dim; ++k) p[k] = x[k](i);
  return p;
}

// Coordinate of nodes that take no part in a pair. They are so far away that every force is exactly
// 0.
inline constexpr double kFarAway = 1e100;

// The geometry that a node is bound to, which restricts its motion: none, a point, a curve or a
// surface.
enum class Carrier : std::int8_t { free, fixed, curve, surface };

// Returns the boundary_node of a node, for its present one `on`, where another copy of a periodic
// domain's cell is seen as the cell.
template <int Dim>
using BoundarySeenFrom =
    std::function<std::int32_t(const Image<Dim>& image, Carrier carrier, std::int32_t on)>;

// The owned nodes and ghosts of a rank.
template <int Dim>
struct Nodes {
  std::int64_t count = 0;
  Field<Dim> x;                 // position
  Field<Dim> v;                 // velocity, length per unit of time
  Field<Dim> reference;         // position at the last event; visibility past the boundary
                                // is determined from it until the next event
  NodeArray<double> d;          // spacing at the node, as of the last refresh
  NodeArray<std::int64_t> id;   // global id
  NodeArray<std::int32_t> tag;  // boundary tag; 0 for inner nodes
  NodeArray<Carrier> carrier;
  NodeArray<std::int32_t> boundary_node;  // in the plane: index into Boundary::nodes, -1 for an
                                          // inner node; in space: see LevelGeometry<3>
  NodeArray<std::int32_t> reference_on;   // in space: boundary_node at the last event
  NodeArray<char> owned;                  // 0: a ghost, owned by another rank
  Carrier moving = Carrier::free;         // nodes with this carrier move, all others stay
  PeriodicCell<Dim> cell;                 // of a periodic domain

  std::int64_t capacity() const { return static_cast<std::int64_t>(d.extent(0)) - 1; }

  // Stamps that data derived from the nodes can be compared with. arrangement() changes with the
  // set of nodes and with their order in memory.
  std::int64_t arrangement() const { return arrangement_; }
  // Changes with the positions, provided that moved() was called.
  std::int64_t positions() const { return positions_; }
  // Changes with the reference positions.
  std::int64_t references() const { return references_; }
  // Changes with any of these.
  std::int64_t version() const { return arrangement_ + positions_ + references_; }

  // Must be called after positions have been written.
  void moved() { ++positions_; }

  // Sets the reference positions to the current positions. Called at an event.
  void set_reference_positions() {
    for_each("pnpbs::Nodes::set_reference_positions", count, [this](std::int64_t i) {
      for (int k = 0; k < Dim; ++k) reference[k](i) = x[k](i);
      if constexpr (Dim == 3) reference_on(i) = boundary_node(i);
    });
    ++references_;
    referenced_at_ = positions_;
  }
  // Returns true if no position has changed since the reference positions were set.
  bool referenced_here() const { return referenced_at_ == positions_; }

  // Sets the padding node behind the last node, which fills up incomplete blocks of the lists. It
  // is far away.
  void set_padding() {
    for (int k = 0; k < Dim; ++k) x[k](count) = kFarAway;
    d(count) = 1;
  }

  // Sets the number of nodes to n and reserves memory for `room` nodes. The caller must then write
  // all attributes.
  void reset(std::int64_t n, std::int64_t room) {
    count = 0;
    reserve(room);
    count = n;
    ++arrangement_;
  }

  // Reserves memory for n nodes and for the padding node behind them.
  void reserve(std::int64_t n) {
    if (n <= capacity()) return;
    require_fits_rank(n, "nodes");
    release_spare();
    for_arrays([&](auto& array, const char* label) { grow_labelled(array, label, n); });
  }
  // Releases the arrays that permute() keeps.
  void release_spare() noexcept { spare_ = Spare(); }

  // Returns an array with an entry per node for a permutation. Its contents are undefined.
  View<std::int32_t>& order_scratch() {
    make_room(order_, "pnpbs::Nodes::order");
    return order_;
  }

  // Reserves memory for n nodes, and a sixteenth more if it has to allocate.
  void reserve_with_room(std::int64_t n) {
    if (n > capacity()) reserve(with_room(n, n / 16));
  }

  void append(const Point<Dim>& position, double spacing, std::int64_t node_id,
              std::int32_t node_tag, Carrier node_carrier, std::int32_t on_boundary) {
    if (count + 1 > capacity()) reserve(with_room(count + 1, count / 8 + 63));
    put(count++, position, spacing, node_id, node_tag, node_carrier, on_boundary);
    ++arrangement_;
  }

  // Writes the attributes of an owned node at rest at index i, which must be within the capacity.
  void put(std::int64_t i, const Point<Dim>& position, double spacing, std::int64_t node_id,
           std::int32_t node_tag, Carrier node_carrier, std::int32_t on_boundary) {
    const Point<Dim> at = cell.rounded(position);
    for (int k = 0; k < Dim; ++k) {
      x[k](i) = at[k];
      v[k](i) = 0;
      reference[k](i) = at[k];
    }
    d(i) = spacing;
    id(i) = node_id;
    tag(i) = node_tag;
    carrier(i) = node_carrier;
    boundary_node(i) = on_boundary;
    if constexpr (Dim == 3) reference_on(i) = on_boundary;
    owned(i) = 1;
  }

  // Returns a deep copy of the nodes.
  Nodes copy() const {
    Nodes copied = *this;
    copied.for_arrays([this](auto& array, const char*) { copy_array(array, count + 1); });
    copied.spare_ = Spare();
    copied.order_ = {};
    return copied;
  }

  // Makes the stamps of this copy newer than those of `replaced`, the nodes that the copy replaces.
  // Different nodes thus never have the same stamp.
  void renew_stamps(const Nodes& replaced) noexcept {
    const bool referenced = referenced_here();
    arrangement_ = replaced.arrangement_ + 1;
    positions_ = replaced.positions_ + 1;
    references_ = replaced.references_ + 1;
    referenced_at_ = referenced ? positions_ : -1;
  }

  Point<Dim> position(std::int64_t i) const { return point_at<Dim>(x, i); }
  void set_position(std::int64_t i, const Point<Dim>& p) {
    const Point<Dim> at = cell.rounded(p);
    for (int k = 0; k < Dim; ++k) x[k](i) = at[k];
  }
  // Returns the position of node i after a move. In a periodic domain it differs exactly by the
  // periods from that of an image of the node after the same move.
  Point<Dim> position_after(std::int64_t i, const Point<Dim>& move) const {
    const Point<Dim> way = cell.rounded(move);
    Point<Dim> to;
    for (int k = 0; k < Dim; ++k) to[k] = x[k](i) + way[k];
    return to;
  }
  // Returns the number of a node, which is part of its id and the same for all of its images.
  std::int64_t number(std::int64_t i) const { return cell.number_of(id(i)); }
  bool moves(std::int64_t i) const { return carrier(i) == moving; }

  // Reorders the nodes: the node at new index i is the one that was at index from(i). Arrays are
  // permuted one by one into spare arrays that are kept, so that rebuilding the lists allocates
  // nothing.
  void permute(const View<std::int32_t>& from) {
    make_spare();  // before any change: if memory is lacking, all arrays keep the same order
    for_arrays([&](auto& array, const char*) { permute_array(array, spare_for(array), from); });
    ++arrangement_;
  }

  // Keeps the nodes at the first `kept` indices in `places`, which must increase, and drops all
  // others. Works in place, with one thread per array.
  void keep(const View<std::int32_t>& places, std::int64_t kept) {
    constexpr int kReal = 3 * Dim + 1;
    std::array<NodeArray<double>, kReal> real;
    for (int k = 0; k < Dim; ++k) {
      real[k] = x[k];
      real[Dim + k] = v[k];
      real[2 * Dim + k] = reference[k];
    }
    real[3 * Dim] = d;
    for_each("pnpbs::Nodes::keep", kReal + (Dim == 3 ? 6 : 5), [&](std::int64_t array) {
      if (array < kReal) keep_in_array(real[static_cast<std::size_t>(array)], places, kept);
      if (array == kReal) keep_in_array(id, places, kept);
      if (array == kReal + 1) keep_in_array(tag, places, kept);
      if (array == kReal + 2) keep_in_array(boundary_node, places, kept);
      if (array == kReal + 3) keep_in_array(owned, places, kept);
      if (array == kReal + 4) keep_in_array(carrier, places, kept);
      if (array == kReal + 5) keep_in_array(reference_on, places, kept);
    });
    count = kept;
    ++arrangement_;
  }

 private:
  static std::int64_t with_room(std::int64_t n, std::int64_t room) {
    return std::max(n, std::min(n + room, kMaxOnRank));
  }

  template <class T>
  void grow_labelled(NodeArray<T>& array, const char* label, std::int64_t n) {
    if (array.extent(0) == 0) {
      array = make_view<T>(label, n + 1);
    } else {
      grow(array.view(), n + 1, count);
    }
  }

  // Calls visit(array, label) for each attribute of the nodes.
  template <class Visit>
  void for_arrays(const Visit& visit) {
    for (int k = 0; k < Dim; ++k) {
      visit(x[k], "pnpbs::Nodes::x");
      visit(v[k], "pnpbs::Nodes::v");
      visit(reference[k], "pnpbs::Nodes::reference");
    }
    visit(d, "pnpbs::Nodes::d");
    visit(id, "pnpbs::Nodes::id");
    visit(tag, "pnpbs::Nodes::tag");
    visit(carrier, "pnpbs::Nodes::carrier");
    visit(boundary_node, "pnpbs::Nodes::boundary_node");
    visit(owned, "pnpbs::Nodes::owned");
    if constexpr (Dim == 3) visit(reference_on, "pnpbs::Nodes::reference_on");
  }

  template <class T>
  static void copy_array(NodeArray<T>& array, std::int64_t n) {
    const View<T> from = array.view();
    if (from.extent(0) == 0) return;
    const View<T> to = make_view<T>("pnpbs::Nodes::copy", n);
    for_each("pnpbs::Nodes::copy", n, [=](std::int64_t i) { to(i) = from(i); });
    array = NodeArray<T>(to);
  }

  template <class T>
  void make_room(View<T>& view, const char* label) const {
    if (view.extent(0) != d.extent(0))
      view = make_view<T>(label, static_cast<std::int64_t>(d.extent(0)));
  }

  template <class T>
  void permute_array(NodeArray<T>& array, View<T>& spare, const View<std::int32_t>& from) {
    const View<T> old = array.view(), ordered = spare;
    for_each("pnpbs::Nodes::permute", count, [=](std::int64_t i) { ordered(i) = old(from(i)); });
    std::swap(array.view(), spare);
  }

  // Most nodes that stay are in long runs of consecutive indices.
  template <class T>
  static void keep_in_array(NodeArray<T>& array, const View<std::int32_t>& places,
                            std::int64_t kept) {
    T* const values = array.data();
    for (std::int64_t begin = 0, end = 0; begin < kept; begin = end) {
      const std::int64_t shift = places(begin) - begin;
      while (end < kept && places(end) - end == shift) ++end;
      if (shift > 0) std::copy(values + begin + shift, values + end + shift, values + begin);
    }
  }

  void make_spare() {
    constexpr const char* kLabel = "pnpbs::Nodes::spare";
    make_room(spare_.real, kLabel);
    make_room(spare_.id, kLabel);
    make_room(spare_.integer, kLabel);
    make_room(spare_.flag, kLabel);
    make_room(spare_.carrier, kLabel);
  }

  struct Spare {
    View<double> real;
    View<std::int64_t> id;
    View<std::int32_t> integer;
    View<char> flag;
    View<Carrier> carrier;
  };
  View<double>& spare_for(const NodeArray<double>&) { return spare_.real; }
  View<std::int64_t>& spare_for(const NodeArray<std::int64_t>&) { return spare_.id; }
  View<std::int32_t>& spare_for(const NodeArray<std::int32_t>&) { return spare_.integer; }
  View<char>& spare_for(const NodeArray<char>&) { return spare_.flag; }
  View<Carrier>& spare_for(const NodeArray<Carrier>&) { return spare_.carrier; }

  Spare spare_;
  View<std::int32_t> order_;
  std::int64_t arrangement_ = 0, positions_ = 0, references_ = 0, referenced_at_ = -1;
};

template <int Dim>
std::int64_t owned_count(const Nodes<Dim>& nodes) {
  return static_cast<std::int64_t>(
      sum_of("pnpbs::owned_count", nodes.count, [&](std::int64_t i) { return nodes.owned(i); }));
}

}  // namespace pnpbs
