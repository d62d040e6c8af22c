// SPDX-License-Identifier: BSD-3-Clause
// Bubbles in a box without a domain, as input for the kernels in 2 and 3 dimensions.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "base/nodes.hpp"
#include "dynamics/schemes.hpp"
#include "neighbors/adjacency_list.hpp"
#include "neighbors/buckets.hpp"
#include "random.hpp"
#include "tree/background_tree.hpp"
#include "unit_box.hpp"

using pnpbs::Box;
using pnpbs::Point;

template <int Dim>
using SpacingFunction = std::function<double(const Point<Dim>&)>;

template <int Dim>
struct Bubble {
  Point<Dim> x;
  double d;
  std::int64_t id;
  bool moves = true;
};

// Step sizes for bubbles in space in tests; they are longer than the defaults of a placement.
inline constexpr pnpbs::Motion kMotionInSpace{0.6, 0.2, 0.2};

template <int Dim>
struct Bubbles {
  Box<Dim> box = unit_box<Dim>();
  pnpbs::BackgroundTree<Dim> tree;
  pnpbs::Nodes<Dim> nodes;
  pnpbs::Buckets<Dim> buckets;
  pnpbs::AdjacencyList<Dim> lists;

  // Builds a tree whose leaves are at most `widest` wide and at most `spacings` times d at their
  // centre.
  void grow_tree(const SpacingFunction<Dim>& d, double spacings = 4, double widest = 1e300) {
    tree.build(box, [&](const pnpbs::BackgroundTree<Dim>& t, std::int32_t first, std::int32_t last,
                        std::vector<char>& split) {
      for (std::int32_t c = first; c < last; ++c)
        split[static_cast<std::size_t>(c - first)] =
            t.cell_side(c) > std::min(widest, spacings * d(t.cell_centre(c)));
    });
    buckets.reset(nullptr);
  }

  void set(const std::vector<Bubble<Dim>>& bubbles) {
    nodes.count = 0;
    nodes.reserve(static_cast<std::int64_t>(bubbles.size()));
    for (const Bubble<Dim>& b : bubbles)
      nodes.append(b.x, b.d, b.id, 0, b.moves ? pnpbs::Carrier::free : pnpbs::Carrier::fixed,
                   b.moves ? -1 : 0);
  }

  // A visibility rule in which any node may be occluded.
  template <class Visible>
  struct Visibility {
    const Visible& visible;
    bool may_occlude(std::int64_t) const { return true; }
  };

  template <class Visible>
  void list(double radius, const Visible& visible,
            pnpbs::ListsOf listed = pnpbs::ListsOf::all_nodes) {
    buckets.sort(tree, nodes, radius);
    lists.build(nodes, buckets, radius, Visibility<Visible>{visible}, listed);
    pad(nodes.x);
    nodes.d(nodes.count) = 1;
  }
  void list(double radius) {
    list(radius, [](std::int64_t, std::int64_t) { return true; });
  }

  // Sets the entry behind the last node to the far-away position that pads lists.
  void pad(pnpbs::Field<Dim>& x) const {
    for (int k = 0; k < Dim; ++k) x[k](nodes.count) = pnpbs::kFarAway;
  }

  std::vector<Bubble<Dim>> bubbles() const {
    std::vector<Bubble<Dim>> all;
    for (std::int64_t i = 0; i < nodes.count; ++i)
      all.push_back({nodes.position(i), nodes.d(i), nodes.id(i), nodes.moves(i)});
    return all;
  }
};

// Returns n bubbles at random positions with random sizes about d. Their ids are large numbers in
// random order.
template <int Dim>
std::vector<Bubble<Dim>> random_bubbles(Random& random, std::int64_t n,
                                        const SpacingFunction<Dim>& d, double variation = 0.3) {
  std::vector<std::int64_t> ids(static_cast<std::size_t>(n));
  for (std::size_t k = 0; k < ids.size(); ++k)
    ids[k] = 1'000'000'000'000 + 7 * static_cast<std::int64_t>(k);
  random.shuffle(ids);
  std::vector<Bubble<Dim>> bubbles;
  for (std::int64_t id : ids) {
    const Point<Dim> x = random.point<Dim>(unit_box<Dim>());
    bubbles.push_back({x, d(x) * random.between(1 - variation, 1 + variation), id});
  }
  return bubbles;
}

// Returns whether x is farther than `rim` from the sides of the box.
template <int Dim>
bool is_inner(const Box<Dim>& box, const Point<Dim>& x, double rim) {
  bool inner = true;
  for (int k = 0; k < Dim; ++k)
    inner = inner && x[k] > box.low[k] + rim && x[k] < box.high[k] - rim;
  return inner;
}

// Returns a hexagonal lattice with this spacing that fills the box. Bubbles within `rim` of the
// sides do not move.
inline std::vector<Bubble<2>> hexagonal_lattice(const Box<2>& box, double spacing, double d,
                                                double rim) {
  std::vector<Bubble<2>> bubbles;
  const double row = spacing * std::sqrt(0.75);
  for (int r = 0; box.low[1] + r * row <= box.high[1]; ++r) {
    for (int c = 0;; ++c) {
      const Point<2> x{box.low[0] + spacing * (c + 0.5 * (r % 2)), box.low[1] + r * row};
      if (x[0] > box.high[0]) break;
      bubbles.push_back(
          {x, d, static_cast<std::int64_t>(bubbles.size()), is_inner<2>(box, x, rim)});
    }
  }
  return bubbles;
}
