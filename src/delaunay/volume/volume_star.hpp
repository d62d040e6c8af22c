// SPDX-License-Identifier: BSD-3-Clause
// The star of a node in the Delaunay triangulation of all nodes of a volume. Inversion x -> x /
// |x|^2 about the node transforms it to the part of a convex hull that does not face the node. The
// hull of nearby nodes is walked facet by facet in double precision. Decisions that rounding could
// change are exact, with ties broken by id. Therefore the stars of all nodes form one
// triangulation, whichever other candidates were examined and in whatever order.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/space_vectors.hpp"
#include "delaunay/volume/element_rule.hpp"

namespace pnpbs {

// Sizes of groups of numbers that are tested at the same time, with one bit for each result.
inline constexpr std::size_t kGroup = 8, kWord = 64;

// Returns the bits of the numbers k < n <= kWord for which test(k) holds.
template <class Test>
inline std::uint64_t bits_where(std::size_t n, const Test& test) {
  std::uint64_t bits = 0;
#pragma omp simd reduction(| : bits)
  for (std::size_t k = 0; k < n; ++k) bits |= static_cast<std::uint64_t>(test(k)) << k;
  return bits;
}

// Returns the same for the n numbers from `first` on, at most kWord of them. Tests run in whole
// groups.
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

  // Begins the star of `centre` without candidates.
  void start(const VolumeNode& centre);
  // Adds a candidate, which must not be added twice. Candidates are numbered in the order of their
  // addition.
  void add(const VolumeNode& candidate);
  // Adds an element that is certain because the star of one of these candidates has it. It must be
  // added once, in positive orientation with the centre. `taken` says whether it belongs to the
  // star.
  void add_known(const Corners& corners, bool taken);

  const VolumeNode& centre() const { return centre_; }
  const std::vector<VolumeNode>& candidates() const { return candidates_; }

  // Finds the tetrahedra of the candidates with the centre. All nodes within `reach` must be
  // candidates. Returns whether no other node can change the elements. If false, the elements are
  // still correct if may_matter is false for all other nodes.
  bool wrap(double reach);
  // Returns whether the known elements surround the centre, so that wrap is unnecessary.
  bool all_known();

  // Returns the maximum distance between corners of an element.
  double max_reach() const { return 2 * kMaxRadius * centre_.d; }
  // Returns the distance from the centre beyond which no node can change the elements.
  double search_reach() const { return search_reach_; }
  // Returns whether a node that is not a candidate can change the elements.
  bool may_matter(const Point<3>& x) const;
  // Returns may_matter for n <= 64 nodes with these coordinates, as bits. A bit is 0 only if the
  // node certainly does not matter.
  std::uint64_t may_matter_bits(const std::array<const double*, 3>& x, std::size_t n) const;
  // Returns whether any node in the box may matter. It is false only if certainly none does.
  bool may_matter_in(const Box<3>& box) const;

  // Takes the elements for which keep(corners) holds, where `corners` are three candidates, and
  // numbers their corners. Known elements are taken as add_known() says.
  template <class Keep>
  void finish(const Keep& keep);
  void finish() {
    finish([](const Corners&) { return true; });
  }

  // --- results of finish ---

  // Candidates that are corners of taken elements, in the order of their ids.
  const std::vector<std::int32_t>& neighbours() const { return neighbours_; }
  // Three indices into neighbours() for each taken element. They have positive orientation with the
  // centre and begin with the smallest one. The triangles are sorted.
  const std::vector<Corners>& triangles() const { return triangles_; }
  // Returns whether the taken elements surround the centre.
  bool closed() const { return closed_; }

 private:
  // The plane of a facet of the hull, normal * y = offset. A node y with a larger product changes
  // the facet.
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
  // Face (centre, from, to) and its normal after inversion. If centre, from and to have equal
  // coordinates on an axis, as on flat surfaces, that coordinate decides exactly on which side of
  // the face a node lies.
  struct Face {
    Edge edge;
    Point<3> normal;
    int common;  // Axis of the equal coordinates; -1 if none.
  };

  // Rounding error of products. Inverted positions have a length of at most 1 and an error of at
  // most 10 half ulps. Products of three of them or of their differences then have an error below
  // 400 half ulps.
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
  std::vector<Point<3>> relative_;  // Candidates relative to the centre.
  // Inverted positions, padded to whole groups with the origin.
  std::array<std::vector<double>, 3> y_;
  std::vector<double> slopes_;     // Scratch space of the same size.
  double unit_ = 1;                // Distance of the nearest candidate, which is 1 after inversion.
  std::vector<double> line_gaps_;  // Squared distances of lines to the nearest, after inversion.
  std::vector<Edge> waiting_;      // Edges of facets whose other facet is to be found.
  // For each candidate, bits of the edges from it that have a facet.
  std::vector<std::uint64_t> done_;
  std::vector<Known> known_;
  std::vector<Facet> facets_;    // Facets in addition to known_.
  std::vector<Face> open_;       // Faces with nothing behind them, see add_open.
  std::vector<Face> shields_;    // All open faces and those of flat tetrahedra.
  std::vector<Plane> unproven_;  // Planes of facets that are not proven.
  bool nothing_found_ = false;
  double search_reach_ = 0;
  std::vector<std::uint64_t> used_;  // One bit per candidate.
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
