// SPDX-License-Identifier: BSD-3-Clause
// Finds vertices and edges of triangles that lie on other triangles up to rounding.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

// Returns an edge with the lower vertex first.
inline std::array<std::int32_t, 2> edge_between(std::int32_t a, std::int32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

// Contacts within a distance of each other, other than common vertices and edges. Edges have the
// lower vertex first. Contacts may occur several times.
struct NearContacts {
  using Edge = std::array<std::int32_t, 2>;

  std::vector<Edge> in_plane;  // two triangles in one plane that have other contacts
  std::vector<std::pair<Edge, std::int32_t>> on_edges;  // an edge and a vertex on it
  std::vector<std::array<Edge, 2>> crossings;           // two edges without a vertex on the other
  // A triangle, and an edge of another triangle on it, or a vertex twice.
  std::vector<std::pair<std::int32_t, Edge>> on_triangles;

  std::size_t count() const { return on_edges.size() + crossings.size() + on_triangles.size(); }
};

// A search for contacts between pairs of triangles.
class NearContactSearch {
 public:
  using Corners = std::array<std::int32_t, 3>;
  using Edge = NearContacts::Edge;

  // The arguments must outlive this object. No two vertices may lie within four times `reach`.
  NearContactSearch(std::span<const Point<3>> positions, double reach)
      : positions_(positions), reach_(reach) {}

  // Adds the contacts of two triangles. Returns false if they have no point in common, near or
  // exact, beside their common vertices and edges.
  bool add_contacts(std::int32_t p, const Corners& corners_p, std::int32_t q,
                    const Corners& corners_q);
  // Adds the contacts of a triangle and a segment of a curve, or a point if its ends are equal.
  // Returns false if they have no other point in common than a common vertex or edge.
  bool add_contacts(std::int32_t p, const Corners& corners_p, const Edge& segment);
  // Adds the contacts of two segments of curves.
  void add_contacts(const Edge& s, const Edge& t);

  NearContacts& contacts() { return contacts_; }

 private:
  // The location of a vertex relative to a triangle. `edge` is the one from corner k to the next.
  struct Location {
    enum class Kind { off, corner, edge, inside } kind = Kind::off;
    int k = 0;
  };

  // The sides of a plane on which the corners of a triangle lie; 0 for corners in it.
  struct Sides {
    std::array<int, 3> of{};
    bool apart = false;  // true if all corners that are not common lie on one side

    bool same(std::size_t i) const { return of[i] * of[(i + 1) % 3] > 0; }
    bool in_plane() const { return of == std::array{0, 0, 0}; }
  };

  const Point<3>& at(std::int32_t v) const { return positions_[static_cast<std::size_t>(v)]; }
  Sides sides_of(const Corners& p, const Corners& q) const;
  bool is_near(const Edge& segment, std::int32_t v) const;
  void add_crossing(const Edge& e, const Edge& f);
  bool lie_beside(const Corners& p, const Corners& q) const;
  Location locate(std::int32_t v, const Corners& triangle) const;
  static bool on_edge(const Location& x, int k);
  void add_on(std::int32_t p, const Corners& corners_p, const Corners& corners_q,
              const Sides& sides_q);
  bool are_apart(const Edge& e, const Edge& f) const;
  void add_crossings(const Corners& p, const Sides& sides_p, const Corners& q,
                     const Sides& sides_q);

  std::span<const Point<3>> positions_;
  double reach_;
  NearContacts contacts_;
};

}  // namespace pnpbs
