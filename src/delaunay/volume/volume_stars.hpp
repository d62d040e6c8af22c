// SPDX-License-Identifier: BSD-3-Clause
// The star of every node of a volume in the Delaunay triangulation of its nodes. It is found from
// the adjacency list and, if that is not sufficient, from nodes farther away, so that each rank
// finds those of its nodes. Ties are broken by id, so that the stars of all ranks form one
// triangulation. The centroid decides whether a tetrahedron belongs to the domain. Surfaces alone
// have triangles instead.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/chunked_rows.hpp"
#include "base/nodes.hpp"
#include "delaunay/volume/element_labels.hpp"
#include "delaunay/volume/surface_rings.hpp"
#include "geometry/facet_index.hpp"
#include "neighbors/adjacency_list.hpp"
#include "neighbors/buckets.hpp"
#include "partition/known_region.hpp"

namespace pnpbs {

// The data from which the stars are found, all for the same positions.
struct VolumeStarInput {
  const Nodes<3>& nodes;
  const BackgroundTree<3>& tree;
  const Buckets<3>& buckets;
  const AdjacencyList<3>& lists;
  const KnownRegion<3>& known;
  const FacetIndex<3>* facets = nullptr;  // Facets of the boundary; null if everything is inside.
  // Returns whether the list of node i contains all nodes within its radius because the boundary
  // hides none. If not set, all lists do.
  std::function<bool(std::int64_t)> complete = {};
  // Returns a lower bound of the distance from a free node to the facets. If not set, none is
  // known.
  std::function<double(std::int64_t)> room = {};
  // Returns whether four nodes, none of them free, lie adjacent on one surface that bounds the
  // domain. A flat tetrahedron of such nodes is not part of the domain if the surface is equally
  // good without it. If not set, none do.
  std::function<bool(const std::array<std::int64_t, 4>&)> on_one_surface = {};
  // Returns whether two nodes, none of them free, are adjacent on a feature edge. If not set, none
  // are.
  std::function<bool(std::int64_t, std::int64_t)> joined = {};
  // Returns the point of the surfaces nearest to x within `reach`. It is set if `joined` is.
  std::function<NearestPoint<3>(const Point<3>& x, double reach)> nearest = {};
  const ChangedLabels* changed_labels = nullptr;
};

class VolumeStars {
 public:
  using Corners = std::array<std::int32_t, 3>;

  void build(const VolumeStarInput& input);
  // Makes all stars empty, so that add can find some of them.
  void build_none(const VolumeStarInput& input);
  // Finds the stars of the nodes for which `wanted` is set and leaves the others unchanged.
  void add(const VolumeStarInput& input, const std::vector<char>& wanted);
  void build(const SurfaceStarInput& input);

  // Marks the stars of the nodes for which `doubtful` is set as possibly wrong, so that they are
  // found again.
  void doubt(const std::vector<char>& doubtful);

  // Returns whether the stars are of these nodes in their present order.
  bool are_of(const Nodes<3>& nodes) const { return arrangement_ == nodes.arrangement(); }

  // Replaces the stars of the nodes for which `changed` is set. write(i, out) appends the star in
  // the format described below.
  template <class Write>
  void replace(const std::vector<char>& changed, const Write& write) {
    note_found(changed);
    rows_.rewrite(
        "pnpbs::VolumeStars::replace", std::ssize(changed),
        [&](std::int64_t i) { return changed[static_cast<std::size_t>(i)] != 0; },
        [&] { return write; });
  }

  // Removes the stars of the nodes for which `unwanted` is set.
  void remove(const std::vector<char>& unwanted);

  // Calls visit(j) for the neighbours of node i in ascending order of ids. These are the other
  // corners of tetrahedra of the domain, or of triangles, around it.
  template <class Visit>
  void for_neighbours(std::int64_t i, const Visit& visit) const {
    const Star star = star_of(i);
    for (std::int32_t k = 0; k < star.neighbours; ++k)
      visit(static_cast<std::int64_t>(star.first[k]));
  }

  // Calls visit(corners) for the tetrahedra of the domain around node i. Their other corners have
  // positive orientation with it. The order depends on ids only.
  template <class Visit>
  void for_simplices(std::int64_t i, const Visit& visit) const {
    if (on_surfaces_) return;
    const Star star = star_of(i);
    for (const std::int32_t* t = star.first + star.neighbours; t < star.last;
         t += star.wide ? 3 : 1)
      visit(star.wide ? Corners{t[0], t[1], t[2]} : unpack(star, *t));
  }

  // Calls visit(corners) for the triangles around node i if the domain consists of surfaces alone.
  // The other corners follow node i counter-clockwise.
  template <class Visit>
  void for_triangles(std::int64_t i, const Visit& visit) const {
    if (!on_surfaces_) return;
    const Star star = star_of(i);
    for (const std::int32_t* t = star.first + star.neighbours; t < star.last; t += 2)
      visit(std::array<std::int32_t, 2>{t[0], t[1]});
  }
  bool are_on_surfaces() const { return on_surfaces_; }

  // Calls visit(places) for the tetrahedra around node i, with the indices of their other corners
  // among its neighbours. The node must have at most kMaxPlaces neighbours.
  template <class Visit>
  void for_triangles_of_indices(std::int64_t i, const Visit& visit) const {
    const Star star = star_of(i);
    for (const std::int32_t* t = star.first + star.neighbours; t < star.last; ++t)
      visit(places_in(*t));
  }
  // Returns whether the triangle is certainly in the star. The smallest index must come first.
  // Returns false for a star of more than kMaxPlaces neighbours.
  bool has_triangle_of_indices(std::int64_t i, const Corners& places) const {
    const Star star = star_of(i);
    return !star.wide &&
           std::find(star.first + star.neighbours, star.last, pack(places)) != star.last;
  }
  // Returns the star of node i in the format described below.
  std::span<const std::int32_t> row(std::int64_t i) const { return rows_.row(i); }
  // Returns the number of entries, counted from the first one, of a star of tetrahedra that are its
  // header and nodes. `size` is the number of all.
  static std::size_t header_and_nodes(std::int32_t header, std::size_t size) {
    const auto n = static_cast<std::size_t>(header / 2);
    return n > static_cast<std::size_t>(kMaxPlaces) ? size : n + 1;
  }
  // Appends a star of tetrahedra to `out`, in which number(j) replaces node j.
  template <class Number>
  static void renumber(std::span<const std::int32_t> row, const Number& number,
                       std::vector<std::int32_t>& out) {
    const std::size_t nodes = header_and_nodes(row[0], row.size());
    out.push_back(row[0]);
    for (std::size_t k = 1; k < nodes; ++k) out.push_back(number(row[k]));
    for (std::size_t k = nodes; k < row.size(); ++k) out.push_back(row[k]);
  }

  // Frees the stars of the kChunk nodes from c * kChunk on.
  void drop_chunk(std::int64_t c) { rows_.drop_chunk(c); }

  // Returns whether the star of node i has been found and not been marked as doubtful since.
  bool found(std::int64_t i) const {
    return found_.empty() || found_[static_cast<std::size_t>(i)] != 0;
  }
  // Returns 0 if the star of node i has been found. Otherwise returns the distance up to which all
  // nodes around it must be known.
  double needs(std::int64_t i) const {
    return needs_.empty() ? 0 : needs_[static_cast<std::size_t>(i)];
  }

  std::int32_t size(std::int64_t i) const { return star_of(i).neighbours; }
  // Returns whether tetrahedra of the domain, or triangles, surround the node.
  bool closed(std::int64_t i) const { return star_of(i).closed; }

  // Number of consecutive nodes whose stars are found one after the other. Each uses what the ones
  // before it have found.
  static constexpr int kChunk = 512;

  // --- format of a star: a header, the neighbours, the triangles ---

  // Three indices among at most kMaxPlaces neighbours are packed into one number. For larger stars,
  // each triangle is stored as three nodes.
  static constexpr int kIndexBits = 10;
  static constexpr std::int32_t kMaxPlaces = 1 << kIndexBits;
  static std::int32_t header(std::size_t neighbours, bool closed) {
    return static_cast<std::int32_t>(2 * neighbours + (closed ? 1 : 0));
  }
  static std::int32_t pack(const Corners& places) {
    return places[0] | places[1] << kIndexBits | places[2] << 2 * kIndexBits;
  }

 private:
  void note_found(const std::vector<char>& more) {
    for (std::size_t i = 0; i < found_.size(); ++i) found_[i] = found_[i] || more[i];
  }

  struct Star {
    std::int32_t neighbours;
    bool closed, wide;
    const std::int32_t *first, *last;  // The row behind its header.
  };
  Star star_of(std::int64_t i) const {
    const std::span<const std::int32_t> row = rows_.row(i);
    const std::int32_t n = row[0] / 2;
    return {n, row[0] % 2 != 0, n > kMaxPlaces, row.data() + 1, row.data() + row.size()};
  }
  static Corners places_in(std::int32_t packed) {
    constexpr std::int32_t kMask = kMaxPlaces - 1;
    return {packed & kMask, packed >> kIndexBits & kMask, packed >> 2 * kIndexBits};
  }
  static Corners unpack(const Star& star, std::int32_t packed) {
    const Corners places = places_in(packed);
    return {star.first[places[0]], star.first[places[1]], star.first[places[2]]};
  }

  ChunkedRows<std::int32_t, kChunk> rows_;
  bool on_surfaces_ = false;
  std::int64_t arrangement_ = -1;  // Arrangement of the nodes when the stars were found.
  std::vector<double> needs_;      // One per node; empty if all nodes are known everywhere.
  std::vector<char> found_;        // One per node; empty if all stars are found at once.
};

}  // namespace pnpbs
