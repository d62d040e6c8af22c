// SPDX-License-Identifier: BSD-3-Clause
#include "quality/plane/first_row.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "base/execution.hpp"
#include "geometry/plane/segments.hpp"
#include "method/constants.hpp"

namespace pnpbs {

namespace {

// Returns the local index of each boundary node, or -1 for boundary nodes that this rank does not
// have.
std::vector<std::int32_t> places_of_boundary_nodes(const Nodes<2>& nodes, std::size_t count) {
  std::vector<std::int32_t> place(count, -1);
  for (std::int32_t i = 0; i < nodes.count; ++i)
    if (nodes.boundary_node(i) >= 0) place[static_cast<std::size_t>(nodes.boundary_node(i))] = i;
  return place;
}

// Returns the edges at all boundary nodes that this rank has. An edge may be repeated.
std::vector<std::int32_t> edges_at(const std::vector<std::int32_t>& places,
                                   const IncidentSectors& sectors) {
  std::vector<std::int32_t> edges;
  for (std::int32_t b = 0; b < std::ssize(places); ++b) {
    if (places[static_cast<std::size_t>(b)] < 0) continue;
    for (std::int32_t k = sectors.begin(b); k < sectors.end(b); ++k)
      edges.push_back(sectors.edge(k).edge);
  }
  return edges;
}

// Relates every inner node to the apexes near it and derives the changes.
class FirstRowChoice {
 public:
  FirstRowChoice(const Nodes<2>& nodes, const AdjacencyList<2>& lists, const SizedTree<2>& map,
                 const IncidentSectors& sectors,
                 const std::function<double(std::int32_t)>& boundary_spacing)
      : nodes_(nodes),
        lists_(lists),
        map_(map),
        sectors_(sectors),
        boundary_places_(places_of_boundary_nodes(nodes, map.boundary().nodes.size())),
        apexes_(map, sectors, boundary_spacing, edges_at(boundary_places_, sectors)),
        relations_(static_cast<std::size_t>(nodes.count)) {
    apexes_.drop([&](const BoundaryApex& apex) { return d_is_steep_beside(apex); });
    for_each("pnpbs::first_row::relations", nodes.count, [&](std::int64_t i) {
      if (nodes.moves(i)) relations_[static_cast<std::size_t>(i)] = relation_of(i);
    });
  }

  FirstRow choose() const {
    FirstRow row;
    const std::vector<std::int32_t> occupants = nearest_nodes();
    for (std::size_t k = 0; k < occupants.size(); ++k) {
      const BoundaryApex& apex = apexes_.all()[k];
      if (!apex.stands) continue;
      if (occupants[k] >= 0)
        row.moved.push_back({occupants[k], apex.place});
      else
        insert_node_at(apex, row.change);
    }
    for (std::int32_t i = 0; i < nodes_.count; ++i) {
      const Relation& r = relation(i);
      const bool in_row = r.apex >= 0 && occupants[static_cast<std::size_t>(r.apex)] == i;
      if (nodes_.owned(i) && !in_row && (r.apex >= 0 || r.beside_covered_edge))
        row.change.deleted.push_back(i);
    }
    return row;
  }

 private:
  // Relation of an inner node to the first row.
  struct Relation {
    std::int64_t apex = -1;  // index of the nearest apex within range, or -1
    double gap = 0;          // distance to that apex
    // whether the closest edge has an apex and is near
    bool beside_covered_edge = false;
  };

  const Relation& relation(std::int64_t i) const { return relations_[static_cast<std::size_t>(i)]; }

  // Returns whether d grows inwards faster than nodes can follow, or falls too fast: the row would
  // have far too many or too few nodes. Also true if the rank does not have the edge's first node.
  bool d_is_steep_beside(const BoundaryApex& apex) const {
    const std::int32_t i = first_node_of(apex);
    bool steep = i < 0;
    if (!steep)
      lists_.for_neighbours(i, [&](std::int64_t j) {
        const double growth =
            (nodes_.d(j) - nodes_.d(i)) / distance<2>(nodes_.position(i), nodes_.position(j));
        steep = steep || growth > method::kTooSteep * method::kGrowthFollowed ||
                growth < -method::kFirstRowMaxFall;
      });
    return steep;
  }

  // Returns the first node of the apex's edge, or -1 if this rank does not have it.
  std::int32_t first_node_of(const BoundaryApex& apex) const {
    return boundary_places_[static_cast<std::size_t>(map_.facet(apex.edge).begin)];
  }

  Relation relation_of(std::int64_t i) const {
    const Point<2> x = nodes_.position(i);
    Relation found;
    double nearest_edge = std::numeric_limits<double>::infinity();
    for_edges_near(i, [&](std::int32_t edge) {
      const auto& [a, b] = map_.corners(edge);
      const std::int64_t apex = apexes_.over(edge, is_left_of(a, b, x));
      if (apex >= 0) relate_to(apex, x, found);
      const double way = distance_to_segment(a, b, x);
      const bool covered = apex >= 0 && way < method::kFirstRowDepth * at(apex).edge_length;
      // At a boundary node both of its edges are equally near, and one with an apex counts.
      if (way < nearest_edge || (way == nearest_edge && covered))
        found.beside_covered_edge = covered;
      nearest_edge = std::min(nearest_edge, way);
    });
    return found;
  }

  // Stores the apex if it is the nearest of those within range. Ties go to the apex with the
  // smaller index.
  void relate_to(std::int64_t apex, const Point<2>& x, Relation& found) const {
    const double gap = distance<2>(at(apex).place, x);
    if (gap >= method::kApexTakes * at(apex).edge_length) return;
    if (found.apex >= 0 && (gap > found.gap || (gap == found.gap && apex > found.apex))) return;
    found.apex = apex;
    found.gap = gap;
  }

  const BoundaryApex& at(std::int64_t apex) const {
    return apexes_.all()[static_cast<std::size_t>(apex)];
  }

  // Calls visit(edge) for the edges at the boundary nodes in the list of node i. An edge may be
  // visited twice.
  template <class Visit>
  void for_edges_near(std::int64_t i, const Visit& visit) const {
    lists_.for_neighbours(i, [&](std::int64_t j) {
      const std::int32_t b = nodes_.boundary_node(j);
      if (b < 0) return;
      for (std::int32_t k = sectors_.begin(b); k < sectors_.end(b); ++k)
        visit(sectors_.edge(k).edge);
    });
  }

  static bool is_left_of(const Point<2>& a, const Point<2>& b, const Point<2>& x) {
    return (b[0] - a[0]) * (x[1] - a[1]) > (b[1] - a[1]) * (x[0] - a[0]);
  }

  // Returns for each apex the node nearest to it among the nodes whose nearest apex it is, or -1.
  std::vector<std::int32_t> nearest_nodes() const {
    std::vector<std::int32_t> nearest(apexes_.all().size(), -1);
    const auto is_nearer = [&](std::int64_t i, std::int64_t j) {
      return relation(i).gap < relation(j).gap ||
             (relation(i).gap == relation(j).gap && nodes_.id(i) < nodes_.id(j));
    };
    for (std::int32_t i = 0; i < nodes_.count; ++i) {
      if (relation(i).apex < 0) continue;
      std::int32_t& best = nearest[static_cast<std::size_t>(relation(i).apex)];
      if (best < 0 || is_nearer(i, best)) best = i;
    }
    return nearest;
  }

  // Inserts a node at the apex with the first node of the edge as its parent. Does nothing if that
  // node is not owned, or if it has no inner nodes in its list, as in a level without bubbles.
  void insert_node_at(const BoundaryApex& apex, PopulationChange<2>& change) const {
    const std::int32_t parent = first_node_of(apex);
    if (!nodes_.owned(parent) || !sees_inner_nodes(parent)) return;
    change.born.push_back({apex.place, nodes_.id(parent), nodes_.d(parent)});
    change.parents.push_back(parent);
  }

  bool sees_inner_nodes(std::int64_t i) const {
    bool any = false;
    lists_.for_neighbours(i, [&](std::int64_t j) { any = any || nodes_.moves(j); });
    return any;
  }

  const Nodes<2>& nodes_;
  const AdjacencyList<2>& lists_;
  const SizedTree<2>& map_;
  const IncidentSectors& sectors_;
  std::vector<std::int32_t> boundary_places_;
  BoundaryApexes apexes_;
  std::vector<Relation> relations_;  // one for each node
};

}  // namespace

FirstRow choose_first_row(const Nodes<2>& nodes, const AdjacencyList<2>& lists,
                          const SizedTree<2>& map, const IncidentSectors& sectors,
                          const std::function<double(std::int32_t)>& boundary_spacing) {
  return FirstRowChoice(nodes, lists, map, sectors, boundary_spacing).choose();
}

}  // namespace pnpbs
