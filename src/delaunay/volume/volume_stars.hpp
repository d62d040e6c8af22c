// SPDX-License-Identifier: BSD-3-Clause
// Every node's star in the Delaunay triangulation of a volume's nodes, from its adjacency list and,
// where that is not enough, the nodes farther away; so that each rank finds its own: ties are
// broken by id, and all agree. A tetrahedron belongs to the domain by its centroid. Of surfaces
// alone there are triangles instead.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
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

// What the stars are found from; all for the same positions.
struct VolumeStarInput {
  const Nodes<3>& nodes;
  const BackgroundTree<3>& tree;
  const Buckets<3>& buckets;
  const AdjacencyList<3>& lists;
  const KnownRegion<3>& known;
  const FacetIndex<3>* facets = nullptr;  // of the boundary; none: everything is inside
  // Does the list of node i hold all pairs within its radius, as the boundary hides none? Not set:
  // that of every node does.
  std::function<bool(std::int64_t)> complete = {};
  // Of a free node, which is inside: no facet is nearer to it than this. Not set: that is not
  // known.
  std::function<double(std::int64_t)> room = {};
  // Do these four nodes, none of them free, lie on one surface, side by side? A flat tetrahedron of
  // such is none of the domain if the surface is as well without it. Not set: they do not.
  std::function<bool(const std::array<std::int64_t, 4>&)> on_one_surface = {};
  // Are two nodes, none of them free, next to each other on a feature edge? Not set: none are.
  std::function<bool(std::int64_t, std::int64_t)> joined = {};
  // The point of the surfaces nearest to x, if it is nearer than that. Where `joined` is set.
  std::function<NearestPoint<3>(const Point<3>& x, double reach)> nearest = {};
  const ChangedLabels* changed_labels = nullptr;
};

class VolumeStars {
 public:
  using Corners = std::array<std::int32_t, 3>;

  void build(const VolumeStarInput& input);
  // One after the other: none are there; those of the nodes for which wanted is set come to those
  // that are there.
  void build_none(const VolumeStarInput& input);
  void add(const VolumeStarInput& input, const std::vector<char>& wanted);
  void build(const SurfaceStarInput& input);

  // Those of the nodes for which doubtful is set may not be right any more: they are to be found
  // again.
  void doubt(const std::vector<char>& doubtful);

  // Are they of these nodes, in the order that they have now?
  bool are_of(const Nodes<3>& nodes) const { return arrangement_ == nodes.arrangement(); }

  // The stars of the nodes for which changed is set are there, written anew: write(i, out) as it is
  // told below.
  template <class Write>
  void replace(const std::vector<char>& changed, const Write& write) {
    note_found(changed);
    rows_.rewrite(
        "pnpbs::VolumeStars::replace", std::ssize(changed),
        [&](std::int64_t i) { return changed[static_cast<std::size_t>(i)] != 0; },
        [&] { return write; });
  }

  // Calls visit(j) for the neighbours of node i, the other corners of tetrahedra of the domain, or
  // of triangles, around it, by increasing id.
  template <class Visit>
  void for_neighbours(std::int64_t i, const Visit& visit) const {
    const Star star = star_of(i);
    for (std::int32_t k = 0; k < star.neighbours; ++k)
      visit(static_cast<std::int64_t>(star.first[k]));
  }

  // Calls visit(corners) for the tetrahedra of the domain around node i: their other corners, so
  // that node i and these are of positive orientation; in an order that only ids decide.
  template <class Visit>
  void for_simplices(std::int64_t i, const Visit& visit) const {
    if (on_surfaces_) return;
    const Star star = star_of(i);
    for (const std::int32_t* t = star.first + star.neighbours; t < star.last;
         t += star.wide ? 3 : 1)
      visit(star.wide ? Corners{t[0], t[1], t[2]} : unpack(star, *t));
  }

  // Calls visit(corners) for the triangles of surfaces alone around node i: their other corners,
  // so that with node i before them they turn counter-clockwise.
  template <class Visit>
  void for_triangles(std::int64_t i, const Visit& visit) const {
    if (!on_surfaces_) return;
    const Star star = star_of(i);
    for (const std::int32_t* t = star.first + star.neighbours; t < star.last; t += 2)
      visit(std::array<std::int32_t, 2>{t[0], t[1]});
  }
  bool are_on_surfaces() const { return on_surfaces_; }

  // Calls visit(places) for the tetrahedra around node i: places of their other corners among its
  // neighbours. Of no more than kMaxPlaces neighbours.
  template <class Visit>
  void for_triangles_of_places(std::int64_t i, const Visit& visit) const {
    const Star star = star_of(i);
    for (const std::int32_t* t = star.first + star.neighbours; t < star.last; ++t)
      visit(places_in(*t));
  }
  // Is this one of them, for sure? The least place comes first.
  bool has_triangle_of_places(std::int64_t i, const Corners& places) const {
    const Star star = star_of(i);
    return !star.wide &&
           std::find(star.first + star.neighbours, star.last, pack(places)) != star.last;
  }
  // Writes the star of node i down for nodes in another order: node j is at place[j] now.
  void copy_star(std::int64_t i, const std::vector<std::int32_t>& place,
                 std::vector<std::int32_t>& out) const;

  // The stars of nodes c * kChunk and those after it, so many, are needed no longer.
  void drop_chunk(std::int64_t c) { rows_.drop_chunk(c); }

  // One after the other: has that of node i been asked for, and has it not been doubted since?
  bool found(std::int64_t i) const {
    return found_.empty() || found_[static_cast<std::size_t>(i)] != 0;
  }
  // 0 if the star of node i is there. Otherwise nodes this near to it would have to be known.
  double needs(std::int64_t i) const {
    return needs_.empty() ? 0 : needs_[static_cast<std::size_t>(i)];
  }

  std::int32_t size(std::int64_t i) const { return star_of(i).neighbours; }
  // Are there tetrahedra of the domain, or triangles, all around the node?
  bool closed(std::int64_t i) const { return star_of(i).closed; }

  // So many stars are found one after the other, each with what the ones before it have found.
  static constexpr int kChunk = 512;

  // --- how a star is written down: a header, the neighbours, the triangles ---
  // Three places among the first neighbours fit into one number; of a larger star, triangles are
  // written as three nodes.
  static constexpr int kPlaceBits = 10;
  static constexpr std::int32_t kMaxPlaces = 1 << kPlaceBits;
  static std::int32_t header(std::size_t neighbours, bool closed) {
    return static_cast<std::int32_t>(2 * neighbours + (closed ? 1 : 0));
  }
  static std::int32_t pack(const Corners& places) {
    return places[0] | places[1] << kPlaceBits | places[2] << 2 * kPlaceBits;
  }

 private:
  void note_found(const std::vector<char>& more) {
    for (std::size_t i = 0; i < found_.size(); ++i) found_[i] = found_[i] || more[i];
  }

  struct Star {
    std::int32_t neighbours;
    bool closed, wide;
    const std::int32_t *first, *last;  // behind the header
  };
  Star star_of(std::int64_t i) const {
    const std::span<const std::int32_t> row = rows_.row(i);
    const std::int32_t n = row[0] / 2;
    return {n, row[0] % 2 != 0, n > kMaxPlaces, row.data() + 1, row.data() + row.size()};
  }
  static Corners places_in(std::int32_t packed) {
    constexpr std::int32_t kMask = kMaxPlaces - 1;
    return {packed & kMask, packed >> kPlaceBits & kMask, packed >> 2 * kPlaceBits};
  }
  static Corners unpack(const Star& star, std::int32_t packed) {
    const Corners places = places_in(packed);
    return {star.first[places[0]], star.first[places[1]], star.first[places[2]]};
  }

  ChunkedRows<std::int32_t, kChunk> rows_;
  bool on_surfaces_ = false;
  std::int64_t arrangement_ = -1;  // of the nodes, when they were found
  std::vector<double> needs_;      // of the nodes; empty where everything is known
  std::vector<char> found_;        // of the nodes; empty where all are found at once
};

}  // namespace pnpbs
