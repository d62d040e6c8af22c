// SPDX-License-Identifier: BSD-3-Clause
// Judges whether the tetrahedra returned on all ranks form one conforming triangulation of the
// body, equal to that of CGAL for all nodes.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <string>

#include "evaluate_volume.hpp"
#include "gathered_tetrahedra.hpp"

namespace volume_judge {

using gathered::Ids3;
using gathered::Ids4;
using gathered::SpaceNode;
using gathered::Volume;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Places = std::array<std::int64_t, 4>;  // indices of nodes by id, in increasing order
using Point = std::array<double, 3>;

// Known properties of the body: its volume, the tolerance of the triangulation's volume, and a
// function that returns 1 inside, -1 outside, and 0 too near to the surface to decide.
struct Body {
  double volume, tolerance;
  std::function<int(const Point&)> inside;
};

class Judge {
 public:
  Judge(const Volume& all, Body body, std::string what)
      : all_(all), body_(std::move(body)), what_(std::move(what)) {
    for (const SpaceNode& n : all.nodes) place_[n.id] = static_cast<std::int64_t>(place_.size());
  }

  // Returns the number of errors.
  int judge() {
    expect(place_.size() == all_.nodes.size(), "a node has two owners");
    if (wrong_ == 0) expect_copies();
    if (wrong_ == 0) expect_tetrahedra_once();
    if (wrong_ == 0) expect_faces_fit();
    if (wrong_ == 0) expect_closed_boundary();
    if (wrong_ == 0) expect_stars();
    if (wrong_ == 0) expect_volume();
    if (wrong_ == 0) compare_with_reference();
    return wrong_;
  }

 private:
  bool expect(bool condition, const std::string& wrong) {
    if (condition) return true;
    std::fprintf(stderr, "%s: %s\n", what_.c_str(), wrong.c_str());
    ++wrong_;
    return false;
  }

  const SpaceNode& node(std::int64_t place) const {
    return all_.nodes[static_cast<std::size_t>(place)];
  }
  Kernel::Point_3 point(std::int64_t place) const {
    const Point& x = node(place).x;
    return {x[0], x[1], x[2]};
  }
  Places places(const Ids4& ids) const {
    Places t{};
    for (std::size_t k = 0; k < 4; ++k) t[k] = place_.at(ids[k]);
    return t;
  }
  std::string text(std::int64_t place) const {
    const SpaceNode& n = node(place);
    char buffer[256];
    std::snprintf(buffer, sizeof buffer, "\n  id %lld (%.17g, %.17g, %.17g) d %g tag %d of rank %d",
                  static_cast<long long>(n.id), n.x[0], n.x[1], n.x[2], n.d, n.tag, n.owner);
    return buffer;
  }
  template <class Corners>
  std::string text(const Corners& corners) const {
    std::string all;
    for (const std::int64_t place : corners) all += text(place);
    return all;
  }

  void expect_copies() {
    for (const SpaceNode& ghost : all_.ghosts) {
      const auto found = place_.find(ghost.id);
      if (!expect(found != place_.end(), "a ghost is nobody's node")) return;
      const SpaceNode& owned = node(found->second);
      if (!expect(owned.x == ghost.x && owned.d == ghost.d && owned.tag == ghost.tag &&
                      owned.owner == ghost.owner,
                  "ghost " + std::to_string(ghost.id) + " differs from what its owner hands out"))
        return;
    }
  }

  // Expects that each tetrahedron is returned once, by the rank that owns its smallest id, with a
  // positive volume.
  void expect_tetrahedra_once() {
    std::set<Places> seen;
    for (const gathered::OwnedTetrahedron& t : all_.tetrahedra) {
      Places p = places(t.ids);
      expect(
          CGAL::orientation(point(p[0]), point(p[1]), point(p[2]), point(p[3])) == CGAL::POSITIVE,
          "a tetrahedron is inside out or flat:" + text(p));
      std::sort(p.begin(), p.end());
      expect(node(p[0]).owner == t.rank,
             "a tetrahedron is handed out by rank " + std::to_string(t.rank) + ":" + text(p));
      if (!expect(seen.insert(p).second, "a tetrahedron is handed out twice:" + text(p))) return;
    }
    ours_.assign(seen.begin(), seen.end());
  }

  // Returns the triangle with the smallest id first, for comparison.
  static Ids3 turned(Ids3 t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
  }

  // Expects that each face, seen from outside, belongs to one tetrahedron. Behind it lies another
  // tetrahedron, or it is a triangle of the boundary.
  void expect_faces_fit() {
    std::set<Ids3> faces, boundary;
    for (const Ids3& t : all_.boundary)
      expect(boundary.insert(turned(t)).second, "a boundary triangle is handed out twice");
    for (const gathered::OwnedTetrahedron& t : all_.tetrahedra) {
      const auto& [a, b, c, d] = t.ids;
      for (const Ids3& face : {Ids3{a, c, b}, Ids3{a, b, d}, Ids3{b, c, d}, Ids3{a, d, c}})
        if (!expect(faces.insert(turned(face)).second,
                    "two tetrahedra overlap:" + text(places(t.ids))))
          return;
    }
    std::size_t alone = 0;
    for (const Ids3& face : faces) {
      if (faces.count(turned({face[0], face[2], face[1]}))) continue;
      ++alone;
      if (!expect(boundary.count(face) > 0,
                  "no tetrahedron lies behind a face, and it is no boundary triangle:" +
                      text(Ids3{place_.at(face[0]), place_.at(face[1]), place_.at(face[2])})))
        return;
    }
    expect(alone == boundary.size(), std::to_string(boundary.size()) + " boundary triangles, " +
                                         std::to_string(alone) + " faces with nothing behind");
  }

  // Expects that every edge of the boundary occurs once in each direction.
  void expect_closed_boundary() {
    std::map<std::array<std::int64_t, 2>, int> edges;
    for (const Ids3& t : all_.boundary)
      for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
    for (const auto& [edge, times] : edges) {
      const auto back = edges.find({edge[1], edge[0]});
      if (!expect(times == 1 && back != edges.end() && back->second == 1,
                  "a boundary edge is not in two triangles:" +
                      text(std::array{place_.at(edge[0]), place_.at(edge[1])})))
        return;
    }
  }

  void expect_stars() {
    std::set<std::array<std::int64_t, 2>> edges;
    for (const gathered::OwnedTetrahedron& t : all_.tetrahedra)
      for (const std::int64_t a : t.ids)
        for (const std::int64_t b : t.ids)
          if (a != b) edges.insert({a, b});
    std::vector<std::array<std::int64_t, 2>> stars = all_.star_neighbours;
    std::sort(stars.begin(), stars.end());
    expect(std::equal(stars.begin(), stars.end(), edges.begin(), edges.end()),
           "the neighbours in the stars are not those in the tetrahedra");
  }

  double volume_of(const Places& t) const {
    return std::fabs(CGAL::volume(point(t[0]), point(t[1]), point(t[2]), point(t[3])));
  }

  void expect_volume() {
    double sum = 0;
    for (const Places& t : ours_) sum += volume_of(t);
    expect(std::fabs(sum - body_.volume) <= body_.tolerance * body_.volume,
           "the tetrahedra have the volume " + std::to_string(sum) + " instead of " +
               std::to_string(body_.volume));
  }

  CGAL::Bounded_side side(const Places& t, std::int64_t place) const {
    auto [a, b, c, d] = t;
    if (CGAL::orientation(point(a), point(b), point(c), point(d)) == CGAL::NEGATIVE)
      std::swap(a, b);
    return CGAL::side_of_bounded_sphere(point(a), point(b), point(c), point(d), point(place));
  }

  // Returns whether a corner of an adjacent tetrahedron in `others` lies exactly on the sphere of t
  // and none lies inside.
  bool tied(const Places& t, const std::vector<Places>& others) const {
    const auto in_t = [&](std::int64_t place) { return std::count(t.begin(), t.end(), place) > 0; };
    bool on_sphere = false;
    for (const Places& other : others) {
      if (std::none_of(other.begin(), other.end(), in_t)) continue;
      for (const std::int64_t place : other) {
        if (in_t(place)) continue;
        const CGAL::Bounded_side where = side(t, place);
        if (where == CGAL::ON_BOUNDED_SIDE) return false;
        on_sphere = on_sphere || where == CGAL::ON_BOUNDARY;
      }
    }
    return on_sphere;
  }

  // Returns whether the library must not return a tetrahedron of CGAL: it is outside, its
  // circumsphere is larger than possible between nodes that fill the body, or it is flat with all
  // corners on the surface.
  bool is_none_of_the_body(const Places& t) const {
    Point centre{};
    double least = HUGE_VAL, widest = 0;
    bool on_surface = true;
    for (const std::int64_t place : t) {
      least = std::min(least, node(place).d);
      on_surface = on_surface && node(place).tag != 0;
      for (std::size_t k = 0; k < 3; ++k) centre[k] += node(place).x[k] / 4;
      for (const std::int64_t other : t)
        widest = std::max(widest, CGAL::squared_distance(point(place), point(other)));
    }
    if (on_surface && volume_of(t) < 0.02 * std::pow(widest, 1.5)) return true;
    const double square = CGAL::squared_radius(point(t[0]), point(t[1]), point(t[2]), point(t[3]));
    return body_.inside(centre) <= 0 || std::sqrt(square) > 1.999 * least;
  }

  // Expects the same tetrahedra, or other ones on the same sphere where five or more nodes lie
  // exactly on a sphere.
  void compare_with_reference() {
    std::vector<Point> nodes;
    for (const SpaceNode& n : all_.nodes) nodes.push_back(n.x);
    std::vector<Places> theirs = pnpbs_bench::reference_tetrahedra(nodes);
    std::sort(theirs.begin(), theirs.end());
    std::vector<Places> ours_only, theirs_only;
    std::set_difference(ours_.begin(), ours_.end(), theirs.begin(), theirs.end(),
                        std::back_inserter(ours_only));
    std::set_difference(theirs.begin(), theirs.end(), ours_.begin(), ours_.end(),
                        std::back_inserter(theirs_only));
    expect(!ours_.empty(), "no tetrahedra");
    for (const Places& t : ours_only)
      if (!expect(tied(t, theirs_only), "a tetrahedron is not Delaunay:" + text(t))) return;
    for (const Places& t : theirs_only)
      if (!is_none_of_the_body(t) &&
          !expect(tied(t, ours_only), "a tetrahedron is missing:" + text(t)))
        return;
  }

  const Volume& all_;
  Body body_;
  std::string what_;
  std::map<std::int64_t, std::int64_t> place_;  // index of the node with each id
  std::vector<Places> ours_;
  int wrong_ = 0;
};

}  // namespace volume_judge
