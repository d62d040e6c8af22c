// SPDX-License-Identifier: BSD-3-Clause
// The nodes of a level: one array per attribute. Order in memory follows the buckets and has no
// influence on any result; what decides is the id.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/execution.hpp"
#include "core/types.hpp"

namespace pnpbs {

// Where a node that takes no part in a pair is put: so far away that every force is exactly 0.
inline constexpr double kFarAway = 1e100;

template <int Dim>
struct Nodes {
  std::int64_t count = 0;
  std::array<View<double>, Dim> x;       // position
  std::array<View<double>, Dim> v;       // velocity, length per unit of time
  std::array<View<double>, Dim> anchor;  // position at the last event: what the boundary hides
                                         // is judged from there until the next one
  View<double> d;                        // spacing at the node, as last refreshed
  View<std::int64_t> id;                 // global id
  View<std::int32_t> tag;                // 0 inside
  View<std::int32_t> boundary_node;      // index into Boundary::nodes, -1 for an inner node
  View<char> owned;                      // 0: a ghost, another rank's node

  std::int64_t capacity() const { return static_cast<std::int64_t>(d.extent(0)) - 1; }

  // Room for n nodes and, behind them, the one far-away node that pads blocks of lists.
  void reserve(std::int64_t n) {
    if (n <= capacity()) return;
    for (int k = 0; k < Dim; ++k) {
      grow_labelled(x[k], "pnpbs::Nodes::x", n);
      grow_labelled(v[k], "pnpbs::Nodes::v", n);
      grow_labelled(anchor[k], "pnpbs::Nodes::anchor", n);
    }
    grow_labelled(d, "pnpbs::Nodes::d", n);
    grow_labelled(id, "pnpbs::Nodes::id", n);
    grow_labelled(tag, "pnpbs::Nodes::tag", n);
    grow_labelled(boundary_node, "pnpbs::Nodes::boundary_node", n);
    grow_labelled(owned, "pnpbs::Nodes::owned", n);
  }

  void append(const Point<Dim>& position, double spacing, std::int64_t node_id,
              std::int32_t node_tag, std::int32_t on_boundary) {
    if (count + 1 > capacity()) reserve(count + count / 8 + 64);
    for (int k = 0; k < Dim; ++k) {
      x[k](count) = position[k];
      v[k](count) = 0;
      anchor[k](count) = position[k];
    }
    d(count) = spacing;
    id(count) = node_id;
    tag(count) = node_tag;
    boundary_node(count) = on_boundary;
    owned(count) = 1;
    ++count;
  }

  Point<Dim> position(std::int64_t i) const {
    Point<Dim> p;
    for (int k = 0; k < Dim; ++k) p[k] = x[k](i);
    return p;
  }
  void set_position(std::int64_t i, const Point<Dim>& p) const {
    for (int k = 0; k < Dim; ++k) x[k](i) = p[k];
  }
  bool moves(std::int64_t i) const { return boundary_node(i) < 0; }

  // Puts the nodes into the order given: new place i holds what was at from(i); nodes that are
  // not named go. Array by array, so that the extra memory is one array's.
  void permute(const View<std::int32_t>& from, std::int64_t new_count) {
    for (int k = 0; k < Dim; ++k) {
      permute_array(x[k], from, new_count);
      permute_array(v[k], from, new_count);
      permute_array(anchor[k], from, new_count);
    }
    permute_array(d, from, new_count);
    permute_array(id, from, new_count);
    permute_array(tag, from, new_count);
    permute_array(boundary_node, from, new_count);
    permute_array(owned, from, new_count);
    count = new_count;
  }

 private:
  template <class T>
  void grow_labelled(View<T>& view, const char* label, std::int64_t n) {
    if (view.extent(0) == 0) {
      view = make_view<T>(label, n + 1);
    } else {
      grow(view, n + 1, count);
    }
  }

  template <class T>
  static void permute_array(View<T>& view, const View<std::int32_t>& from, std::int64_t new_count) {
    View<T> ordered = make_view<T>(view.label(), static_cast<std::int64_t>(view.extent(0)));
    const View<T> old = view;
    for_each("pnpbs::Nodes::permute", new_count,
             [=](std::int64_t i) { ordered(i) = old(from(i)); });
    view = ordered;
  }
};

}  // namespace pnpbs
