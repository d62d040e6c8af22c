// SPDX-License-Identifier: BSD-3-Clause
// A part of a triangulation with a value at each node, linear on each simplex: what one rank holds
// of a spacing that is given at nodes. Several patches make up the whole; of the answers that they
// give for a point the least one counts, so that it does not matter who holds what.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "tree/box_tree.hpp"

namespace pnpbs {

template <int Dim>
struct PatchNode {
  Point<Dim> x;
  std::int64_t id;
  double value;
};

// In: the coordinates of its nodes, more than Dim on a surface.
template <int Dim, int In = Dim>
struct Patch {
  std::vector<PatchNode<In>> nodes;
  // Indices of nodes, by increasing id in each row.
  std::vector<std::array<std::int32_t, Dim + 1>> simplices;
  std::vector<std::array<std::int32_t, Dim>> border;  // facets with nothing on one side
  // The corner of the simplex on the other side of each of these, or -1; may be left empty.
  std::vector<std::int32_t> behind;
};

// How much each of some nodes counts.
template <int Dim>
struct PatchWeights {
  std::array<std::int32_t, Dim + 1> nodes{};  // of the patch
  std::array<double, Dim + 1> weights{};      // sum up to 1
  bool inside = false;                        // none is negative
};

template <int Dim>
struct PatchAnswer {
  double gap = std::numeric_limits<double>::infinity();  // squared distance to simplex or facet
  std::array<std::int64_t, Dim + 1> ids{};               // of the nodes the value comes from
  double value = 0;
  // Who told it, and of which simplex; of a facet of the border, -1 - its place.
  std::int32_t rank = -1, row = 0;

  bool found() const { return gap < std::numeric_limits<double>::infinity(); }
  bool operator<(const PatchAnswer& other) const {
    return gap != other.gap ? gap < other.gap : ids < other.ids;
  }
};

template <int Dim>
class NodalPatch {
 public:
  static constexpr int kDim = Dim, kIn = Dim;

  NodalPatch() = default;
  explicit NodalPatch(Patch<Dim> patch);

  // From the simplex that holds x; if several do (x on a facet or node), from the one of least
  // ids. Leaves `best` alone if none does.
  void interpolate(const Point<Dim>& x, PatchAnswer<Dim>& best) const;
  // From the nearest point of the border, if it is nearer than `best`.
  void extend(const Point<Dim>& x, PatchAnswer<Dim>& best) const;

  const Patch<Dim>& patch() const { return patch_; }
  // Those with which an answer of this patch is linear around x: on its simplex, or on the one
  // behind its facet, which they continue; of a facet alone, those of its place nearest to x.
  PatchWeights<Dim> weights(const Point<Dim>& x, std::int32_t row) const;

  std::vector<Box<Dim>> simplices_cover(std::size_t many) const { return by_simplex_.cover(many); }
  std::vector<Box<Dim>> border_cover(std::size_t many) const { return by_facet_.cover(many); }

 private:
  Patch<Dim> patch_;
  BoxTree<Dim> by_simplex_, by_facet_;
};

extern template class NodalPatch<2>;
extern template class NodalPatch<3>;

}  // namespace pnpbs
