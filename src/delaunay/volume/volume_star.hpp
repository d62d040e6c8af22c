// SPDX-License-Identifier: BSD-3-Clause
// The star of a node in the Delaunay triangulation of all nodes of a volume. Inversion
// x -> x / |x|^2 about the node makes it the part of a convex hull that does not see the node: of
// the nodes nearby, walked facet by facet in plain doubles. What rounding could change is decided
// exactly, ties by id, so that the stars of all nodes are together one triangulation, whatever
// nodes besides those that matter were looked at, and in whatever order.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/space_vectors.hpp"
#include "delaunay/volume/element_rule.hpp"

namespace pnpbs {

// Tests of many numbers side by side, a bit for each.
inline constexpr std::size_t kGroup = 8, kWord = 64;

// Bits of those among the first n <= kWord numbers for which test(k) holds.
template <class Test>
inline std::uint64_t bits_where(std::size_t n, const Test& test) {
  std::uint64_t bits = 0;
#pragma omp simd reduction(| : bits)
  for (std::size_t k = 0; k < n; ++k) bits |= static_cast<std::uint64_t>(test(k)) << k;
  return bits;
}

// The same for those of n numbers from the first one on; tests are done in whole groups.
template <class Test>
inline std::uint64_t bits_where(std::size_t first, std::size_t n, const Test& test) {
  const std::size_t left = std::min(kWord, n - first);
  return bits_where((left + kGroup - 1) & ~(kGroup - 1),
                    [&](std::size_t k) { return test(first + k); }) &
         (~std::uint64_t{0} >> (kWord - left));
}

class VolumeStar {
 public:
  using Corners = std::array<std::int32_t, 3>;

  // Begins with the node itself, and no candidates.
  void start(const VolumeNode& centre);
  // A candidate, once. Its number is how many there were.
  void add(const VolumeNode& candidate);
  // An element that is there for sure, as the star of one of these three candidates has it; once,
  // in positive orientation with the centre. Is it to be taken?
  void add_known(const Corners& corners, bool taken);

  const VolumeNode& centre() const { return centre_; }
  const std::vector<VolumeNode>& candidates() const { return candidates_; }

  // Finds the tetrahedra that the candidates make with the centre. All nodes nearer to it than
  // `reach` must be among them. Returns whether that is proof: then no other node can change the
  // elements. If not, it still is if there is none that may_matter.
  bool wrap(double reach);
  // Are the known elements all around the centre? Then there is nothing to wrap.
  bool all_known();

  // Elements reach no farther than this from their corners.
  double max_reach() const { return 2 * kMaxRadius * centre_.d; }
  // No node farther away than this may matter.
  double search_reach() const { return search_reach_; }
  // Can a node that is no candidate change the elements?
  bool may_matter(const Point<3>& x) const;
  // The same for n <= 64 nodes, whose coordinates are given, as bits: 0 only if surely not.
  std::uint64_t may_matter_bits(const std::array<const double*, 3>& x, std::size_t n) const;
  // The same for any node in the box: false only if surely not.
  bool may_matter_in(const Box<3>& box) const;

  // Takes the elements for which keep(corners), three candidates, holds, and numbers their corners.
  // Of what is known, it has been decided already.
  template <class Keep>
  void finish(const Keep& keep);
  void finish() {
    finish([](const Corners&) { return true; });
  }

  // --- then ---
  // The candidates that are corners of elements taken, by id.
  const std::vector<std::int32_t>& neighbours() const { return neighbours_; }
  // Three places among the neighbours for each element taken, so that the centre and these are of
  // positive orientation; the least one first, and in order.
  const std::vector<Corners>& triangles() const { return triangles_; }
  // Are the elements taken all around the centre?
  bool closed() const { return closed_; }

 private:
  // The plane of a facet of the hull is normal * y = offset; of the places y with a larger product
  // come the nodes that would change it.
  struct Plane {
    Point<3> normal;
    double offset;
  };
  struct Facet {
    Corners corners;
    Plane plane;
  };
  struct Known {
    Corners corners;
    bool taken;
  };
  struct Edge {
    std::int32_t from, to;
  };
  // Face (centre, from, to), and its normal after inversion. Where all three have a coordinate in
  // common, as on flat surfaces, another node's tells exactly on which side of the face it is.
  struct Face {
    Edge edge;
    Point<3> normal;
    int common;  // -1: none
  };

  // Inverted positions are at most 1 long, and each is wrong by at most 10 half ulps. Then products
  // of three of them, or of their differences, with their own rounding, are wrong by less than 400.
  static constexpr double kRounding = 0x1p-43;

  static std::size_t index(std::int32_t k) { return static_cast<std::size_t>(k); }
  std::int32_t count() const { return static_cast<std::int32_t>(candidates_.size()); }
  Point<3> inverse(std::int32_t k) const {
    return {y_[0][index(k)], y_[1][index(k)], y_[2][index(k)]};
  }

  void invert();
  void clear_edges();
  void set_known_done();
  void start_at_known();
  std::int32_t nearest() const;
  void start_walk(std::int32_t first);
  void start_walk_exactly(std::int32_t first);
  void walk(double reach);

  Face face_of(const Edge& edge) const;
  Facet facet_of(const Edge& edge, std::int32_t corner) const;
  static bool share_a_coordinate(const Point<3>& a, const Point<3>& b, const Point<3>& c);
  int side(const Point<3>& normal, std::int32_t a, std::int32_t b, std::int32_t c) const;
  bool surely_below(const Plane& plane, std::int32_t k) const;
  bool beyond(const Facet& facet, std::int32_t k) const;
  bool all_surely_below(const Plane& plane, const Corners& facet) const;
  bool find_facet(const Edge& edge, Facet& facet);
  bool find_facet_exactly(const Edge& edge, Facet& facet) const;
  void add_open(const Face& face);
  void add_facet(const Facet& facet, double reach);
  bool is_done(const Edge& edge) const;
  void set_done(const Edge& edge);
  bool in_front(const Face& face, const Point<3>& x, const Point<3>& y) const;
  bool is_shielded(const Point<3>& y) const;
  bool is_element(const Facet& facet) const;
  void number_corners();
  void find_neighbours();

  VolumeNode centre_{};
  std::vector<VolumeNode> candidates_;
  std::vector<Point<3>> relative_;        // to the centre
  std::array<std::vector<double>, 3> y_;  // inverted, in whole groups filled up with the origin
  std::vector<double> slopes_;            // of as many
  double unit_ = 1;                       // distance of the nearest candidate: 1 after inversion
  std::vector<double> line_gaps_;         // after inversion: of lines to the nearest, squared
  std::vector<Edge> waiting_;             // edges of facets whose other facet is to be found
  std::vector<std::uint64_t> done_;       // for each candidate: edges from it that have a facet
  std::vector<Known> known_;
  std::vector<Facet> facets_;    // besides
  std::vector<Face> open_;       // with nothing behind, see add_open
  std::vector<Face> shields_;    // all of these, and those of flat tetrahedra
  std::vector<Plane> unproven_;  // of facets
  bool nothing_found_ = false;
  double search_reach_ = 0;
  std::vector<std::uint64_t> used_;  // a bit for each candidate
  std::vector<std::int32_t> neighbours_, place_;
  std::vector<std::int64_t> packed_;
  std::vector<Corners> triangles_;
  bool closed_ = false;
};

template <class Keep>
void VolumeStar::finish(const Keep& keep) {
  triangles_.clear();
  for (const Known& known : known_)
    if (known.taken) triangles_.push_back(known.corners);
  for (const Facet& facet : facets_)
    if (is_element(facet) && keep(facet.corners)) triangles_.push_back(facet.corners);
  closed_ =
      open_.empty() && !triangles_.empty() && triangles_.size() == known_.size() + facets_.size();
  number_corners();
}

}  // namespace pnpbs
