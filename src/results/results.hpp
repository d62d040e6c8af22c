// SPDX-License-Identifier: BSD-3-Clause
// The results of a level: its nodes in the order of results, lists, stars, elements, facets and
// figures. They are prepared on request and kept until the nodes move.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "domain/domain.hpp"
#include "level/level.hpp"
#include "level/rebalance.hpp"
#include "level/volume/inner_facets.hpp"
#include "results/facet_tag.hpp"
#include "results/nodal_results.hpp"

namespace pnpbs {

class MidNodes;
template <int Dim>
class Cracks;

// Results in the plane or in space. Calls with `visit` use result indices.
template <int Dim>
class Results : public NodalResults {
 public:
  // Creates results without a level.
  Results(std::shared_ptr<const Communicator> comm, std::shared_ptr<const Domain<Dim>> domain)
      : NodalResults(std::move(comm)), domain_(std::move(domain)) {}

  // Installs `level`, or no level if it is null. The level must outlive its use here.
  void show(Level<Dim>* level) { level_ = level; }
  Level<Dim>* shown() const { return level_; }

  int dimension() const override { return Dim; }
  int coordinates() const override { return embedding().coordinates(); }
  decltype(auto) embedding() const { return domain_->embedding(); }
  double sphere_radius() const override { return embedding().radius(); }
  bool has_nodes() const override { return level_ != nullptr; }
  const Level<Dim>& level() const { return *level_; }
  // The user's domain. The user may have changed it since the level was built.
  const Domain<Dim>& domain() const { return *domain_; }
  // Counts the owned nodes, unless the order of results is prepared.
  std::int64_t count() const override;
  std::int64_t held() const override { return level_ ? level_->nodes.count : 0; }
  NodeColumns nodes() const override;
  void prepare_order() override;
  void prepare_lists() override;
  void prepare_stars() override;
  void agree_on_derived() noexcept override;
  // Returns the mid nodes of elements of second order (mid_nodes.hpp). All ranks must call it, and
  // if one rank throws, all ranks throw.
  const MidNodes& mid_nodes();
  // Returns the cracks along the curves or surfaces with the crack tags (cracks.hpp), and in a
  // periodic domain the copies of nodes where it is cut open (periodic_cut.hpp). All ranks must
  // call it, and if one rank throws, all ranks throw.
  const Cracks<Dim>& cracks();
  bool has_copies() const { return !crack_tags_.empty() || level_->nodes.cell.any(); }
  // Calls visit(corners) for every element, a triangle or a tetrahedron, once over all ranks: at
  // the owner of its node with the smallest id, which is the first corner. Requires
  // prepare_stars().
  template <class Visit>
  void for_elements(const Visit& visit) const {
    for_elements(0, count(), visit);
  }
  // Visits only the elements whose first corner has a result index in [begin, end), in its order.
  template <class Visit>
  void for_elements(std::int64_t begin, std::int64_t end, const Visit& visit) const;
  // Calls visit(corners, tag) for every facet of the boundary once over all ranks. In the plane,
  // the owner of its first node visits an edge; this requires prepare_order(). In space, these are
  // the open facets; this requires prepare_stars().
  template <class Visit>
  void for_boundary_facets(const Visit& visit) const;
  template <class Visit>
  void for_boundary_facets(std::int64_t begin, std::int64_t end, const Visit& visit) const
      requires(Dim == 3);
  // Calls visit(ends, edge) for the boundary edges in the plane.
  template <class Visit>
  void for_boundary_edges(const Visit& visit) const requires(Dim == 2);
  // Calls visit(corners) for every face that belongs to only one tetrahedron, once over all ranks:
  // at the owner of its node with the smallest id, which is the first corner. The order of the
  // corners is counter-clockwise as seen from outside. Requires prepare_stars().
  template <class Visit>
  void for_open_facets(const Visit& visit) const requires(Dim == 3) {
    for_open_facets(0, count(), visit);
  }
  // Visits only the faces whose first corner has a result index in [begin, end), in its order. On a
  // surface without a body it visits all triangles.
  template <class Visit>
  void for_open_facets(std::int64_t begin, std::int64_t end, const Visit& visit) const
      requires(Dim == 3);
  // Calls visit(corners, tag) for every face between tetrahedra that represents an inner surface,
  // once over all ranks: at the owner of its node with the smallest id, which is the first corner
  // and has a result index in [begin, end). The orientation is that of the surface. Requires
  // prepare_stars().
  template <class Visit>
  void for_inner_facets(std::int64_t begin, std::int64_t end, const Visit& visit) const
      requires(Dim == 3);
  template <class Visit>
  void for_inner_facets(const Visit& visit) const requires(Dim == 3) {
    for_inner_facets(0, count(), visit);
  }
  GeometryKind kind() const override { return level_ ? level_->geometry.kind() : domain_->kind(); }
  // Calls visit(corners, tag) for every facet once over all ranks: those of the boundary and, in
  // space, those of inner surfaces. Requires prepare_stars().
  template <class Visit>
  void for_facets(const Visit& visit) const {
    for_boundary_facets(visit);
    if constexpr (Dim == 3) for_inner_facets(visit);
  }
  // Calls visit(corners) for the same facets. It saves the search for the tag in space.
  template <class Visit>
  void for_facets_without_tags(const Visit& visit) const {
    const auto without_tag = [&](const auto& places, auto...) { visit(places); };
    if constexpr (Dim == 3) {
      for_open_facets(without_tag);
      for_inner_facets(without_tag);
    } else {
      for_boundary_facets(without_tag);
    }
  }
  // Return position and d of a node by its memory index, in the coordinates of the user. On a
  // sphere these are not those of the chart. In the plane z is 0.
  Point<3> point_in_space(std::int64_t node) const;
  double spacing_at(std::int64_t node) const;
  int owner_of(std::int64_t node) const {
    return level_->tree->owner_at(level_->nodes.position(node));
  }
  std::shared_ptr<const ExchangePattern> exchange_pattern() override;

  LevelFigures level_figures() const override;
  Speeds speeds() const override { return level_ ? speeds_of(*level_) : Speeds{}; }
  std::int64_t boundary_nodes() const override;
  double imbalance() const override { return level_ ? imbalance_of(*level_) : 1; }
  NearestNeighbourError spacing_error() override;
  const ElementQuality& element_quality() override;
  std::uint64_t hash() const override;

 private:
  void require_nodes() const;
  LevelStamp stamp() const override { return level_ ? level_->stamp() : LevelStamp(); }

  void put_on_sphere() const;
  View<const std::int64_t> numbers() const;

  std::shared_ptr<const Domain<Dim>> domain_;
  Level<Dim>* level_ = nullptr;
  // On a sphere: the attributes of nodes() in the order of memory, computed on request.
  mutable std::array<View<double>, 3> on_sphere_;
  mutable View<double> spacing_on_sphere_;
  mutable LevelStamp on_sphere_stamp_;
  // In a periodic domain: the numbers of the nodes in the order of memory, computed on request.
  mutable View<std::int64_t> numbers_;
  mutable LevelStamp numbers_stamp_;
  std::shared_ptr<const MidNodes> mid_nodes_;
  LevelStamp mid_nodes_stamp_;
  std::shared_ptr<const Cracks<Dim>> cracks_;
};

// A scope in which results show another level, such as one under construction.
template <int Dim>
class ScopedLevel {
 public:
  ScopedLevel(Results<Dim>& results, Level<Dim>* level)
      : results_(results), before_(results.shown()) {
    results.show(level);
  }
  ScopedLevel(const ScopedLevel&) = delete;
  ScopedLevel& operator=(const ScopedLevel&) = delete;
  ~ScopedLevel() { results_.show(before_); }

 private:
  Results<Dim>& results_;
  Level<Dim>* before_;
};

extern template class Results<2>;
extern template class Results<3>;

template <int Dim>
template <class Visit>
void Results<Dim>::for_elements(std::int64_t begin, std::int64_t end, const Visit& visit) const {
  const NodeArray<std::int64_t>& id = level_->nodes.id;
  for (std::int64_t p = begin; p < end; ++p) {
    const std::int64_t i = node_at(p);
    level_->stars.for_simplices(i, [&](const typename Stars<Dim>::Corners& others) {
      std::array<std::int64_t, Dim + 1> places{p};
      for (std::size_t k = 0; k < Dim; ++k) {
        if (id(others[k]) < id(i)) return;
        places[k + 1] = place_of(others[k]);
      }
      visit(places);
    });
  }
}

template <int Dim>
template <class Visit>
void Results<Dim>::for_boundary_facets(const Visit& visit) const {
  if constexpr (Dim == 2)
    for_boundary_edges([&](const std::array<std::int64_t, 2>& places, const BoundaryEdge& e) {
      visit(places, e.tag);
    });
  else
    for_boundary_facets(0, count(), visit);
}

template <int Dim>
template <class Visit>
void Results<Dim>::for_boundary_edges(const Visit& visit) const requires(Dim == 2) {
  const Boundary& boundary = level_->geometry.boundary();
  const Nodes<2>& nodes = level_->nodes;
  std::vector<std::int64_t> place(boundary.nodes.size(), -1);
  for (std::int64_t i = 0; i < nodes.count; ++i)
    if (const std::int32_t b = nodes.boundary_node(i); b >= 0)
      place[static_cast<std::size_t>(b)] = place_of(i);
  const std::int64_t owned = count();
  for (const BoundaryEdge& e : boundary.facets) {
    if (e.begin == e.end) continue;  // the edge of a fixed node
    // The closing triangle lies behind it.
    if (level_->geometry.domain().closing() && e.bounds()) continue;
    const std::int64_t begin = place[static_cast<std::size_t>(e.begin)];
    if (begin >= 0 && begin < owned)
      visit(std::array<std::int64_t, 2>{begin, place[static_cast<std::size_t>(e.end)]}, e);
  }
}

template <int Dim>
template <class Visit>
void Results<Dim>::for_boundary_facets(std::int64_t begin, std::int64_t end,
                                       const Visit& visit) const requires(Dim == 3) {
  for_open_facets(begin, end, [&](const std::array<std::int64_t, 3>& places) {
    const auto [a, b, c] = places;
    visit(places, facet_tag(*level_, {node_at(a), node_at(b), node_at(c)}));
  });
}

template <int Dim>
template <class Visit>
void Results<Dim>::for_inner_facets(std::int64_t begin, std::int64_t end, const Visit& visit) const
    requires(Dim == 3) {
  InnerFacets facets(*level_);
  for (std::int64_t p = begin; p < (facets.any() ? end : begin); ++p)
    for (const InnerFacet& facet : facets.at(node_at(p)))
      visit(std::array<std::int64_t, 3>{p, place_of(facet.nodes[1]), place_of(facet.nodes[2])},
            facet.tag);
}

// Faces that occur once among the tetrahedra around a node belong to one tetrahedron only.
template <int Dim>
template <class Visit>
void Results<Dim>::for_open_facets(std::int64_t begin, std::int64_t end, const Visit& visit) const
    requires(Dim == 3) {
  const NodeArray<std::int64_t>& id = level_->nodes.id;
  struct Face {
    std::int64_t low, high;               // ids of the other two nodes
    std::array<std::int64_t, 3> turning;  // result indices, counter-clockwise as seen from outside
  };
  std::vector<Face> faces;
  for (std::int64_t p = begin; p < end; ++p) {
    const std::int64_t i = node_at(p);
    level_->stars.for_triangles(i, [&](const std::array<std::int32_t, 2>& others) {
      const auto [a, b] = others;
      if (id(i) < id(a) && id(i) < id(b))
        visit(std::array<std::int64_t, 3>{p, place_of(a), place_of(b)});
    });
    if (level_->stars.closed(i)) continue;
    faces.clear();
    level_->stars.for_simplices(i, [&](const typename Stars<Dim>::Corners& others) {
      // The corners (i, a, b, c) are right-handed, so as seen from outside the order of the face is
      // i, b, a.
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t a = others[k], b = others[(k + 1) % 3];
        if (id(a) < id(i) || id(b) < id(i)) continue;
        faces.push_back(
            {std::min(id(a), id(b)), std::max(id(a), id(b)), {p, place_of(b), place_of(a)}});
      }
    });
    std::sort(faces.begin(), faces.end(), [](const Face& f, const Face& g) {
      return f.low != g.low ? f.low < g.low : f.high < g.high;
    });
    const auto same = [&](std::size_t f, std::size_t g) {
      return g < faces.size() && faces[f].low == faces[g].low && faces[f].high == faces[g].high;
    };
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (!same(f, f + 1) && !(f > 0 && same(f, f - 1))) visit(faces[f].turning);
  }
}

// Calls work(results) with the results cast to their dimension.
template <class Work>
decltype(auto) visit_dimension(NodalResults& results, const Work& work) {
  if (results.dimension() == 2) return work(static_cast<Results<2>&>(results));
  return work(static_cast<Results<3>&>(results));
}

}  // namespace pnpbs
