// SPDX-License-Identifier: BSD-3-Clause
// C interface: nodes, ghosts, lists, stars, elements and boundary facets.
#include <algorithm>
#include <vector>

#include "api/placement_calls.hpp"
#include "base/space_vectors.hpp"
#include "check/result_check.hpp"
#include "results/element_regions.hpp"
#include "results/mid_nodes.hpp"
#include "results/node_normal.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

namespace {

template <int Dim>
std::int64_t adjacency_entries(const Results<Dim>& results) {
  const Level<Dim>& level = results.level();
  return static_cast<std::int64_t>(
      sum_of("pnpbs::adjacency_entries", level.nodes.count, [&](std::int64_t i) {
        std::int64_t n = 0;
        if (!level.nodes.owned(i)) return n;
        level.lists().for_neighbours(i, [&](std::int64_t) { ++n; });
        return n;
      }));
}

template <int Dim>
std::int64_t star_entries(const Results<Dim>& results) {
  const Level<Dim>& level = results.level();
  return static_cast<std::int64_t>(
      sum_of("pnpbs::star_entries", level.nodes.count,
             [&](std::int64_t i) { return level.nodes.owned(i) ? level.stars.size(i) : 0; }));
}

// Calls visit(j, triangle) for the neighbours in the star of node i. `triangle` is true if the
// neighbour and the next one form a triangle with i. In space neighbours are not ordered, and
// `triangle` is false.
template <class Visit>
void for_star(const Results<2>& results, std::int64_t i, const Visit& visit) {
  results.level().stars.for_neighbours_in_order(i, visit);
}
template <class Visit>
void for_star(const Results<3>& results, std::int64_t i, const Visit& visit) {
  results.level().stars.for_neighbours(i, [&](std::int64_t j) { visit(j, false); });
}

// Copies the nodes with the indices first .. first + n - 1 in the order of the results. The arrays
// may be NULL.
void copy_nodes(const NodalResults& results, std::int64_t first, std::int64_t n,
                double* coordinates, std::int64_t* ids, std::int32_t* tags, double* spacing) {
  const NodeColumns nodes = results.nodes();
  const int dim = results.coordinates();
  for_each("pnpbs::copy_nodes", n, [&](std::int64_t k) {
    const std::int64_t i = results.node_at(first + k);
    if (coordinates)
      for (int c = 0; c < dim; ++c)
        coordinates[dim * k + c] = nodes.x[static_cast<std::size_t>(c)](i);
    if (ids) ids[k] = nodes.id(i);
    if (tags) tags[k] = nodes.tag(i);
    if (spacing) spacing[k] = nodes.d(i);
  });
}

}  // namespace

pnpbs_status pnpbs_placement_dimension(pnpbs_placement placement, int32_t* dim) {
  return guarded(placement, [&](PlacementObject& object) {
    require_pointer(dim, "dim");
    *dim = object.placement->results().coordinates();
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_sphere_radius(pnpbs_placement placement, double* radius) {
  return guarded(placement, [&](PlacementObject& object) {
    require_pointer(radius, "radius");
    *radius = object.placement->results().sphere_radius();
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_count(pnpbs_placement placement, int64_t* nodes) {
  return guarded(placement, [&](PlacementObject& object) {
    require_pointer(nodes, "nodes");
    *nodes = object.placement->results().count();
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_nodes(pnpbs_placement placement, int64_t capacity,
                                       double* coordinates, int64_t* ids, int32_t* tags,
                                       double* spacing) {
  return guarded(placement, [&](PlacementObject& object) {
    NodalResults& results = object.placement->results();
    require_capacity(capacity, results.count());
    if (results.count() == 0) return PNPBS_OK;
    results.prepare_order();
    copy_nodes(results, 0, results.count(), coordinates, ids, tags, spacing);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_normals(pnpbs_placement placement, int64_t capacity,
                                         double* normals) {
  return guarded(placement, [&](PlacementObject& object) {
    NodalResults& results = object.placement->results();
    const bool of_sphere = results.kind() == GeometryKind::sphere;
    if (!of_sphere) require_dimension<3>(results);
    require_capacity(capacity, results.count());
    if (results.count() == 0) return PNPBS_OK;
    require_pointer(normals, "normals");
    results.prepare_order();
    if (of_sphere) {
      copy_nodes(results, 0, results.count(), normals, nullptr, nullptr, nullptr);
      for (std::int64_t place = 0; place < results.count(); ++place) {
        const Point<3> normal = unit_vector(Point<3>{normals[0], normals[1], normals[2]});
        normals = std::copy(normal.begin(), normal.end(), normals);
      }
      return PNPBS_OK;
    }
    const Results<3>& in = require_dimension<3>(results);
    std::vector<std::int64_t> nodes;
    for (std::int64_t place = 0; place < results.count(); ++place)
      nodes.push_back(results.node_at(place));
    for (const Point<3>& normal : node_normals(in.level(), nodes))
      normals = std::copy(normal.begin(), normal.end(), normals);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_ghost_count(pnpbs_placement placement, int64_t* ghosts) {
  return collective_results(placement, [&](NodalResults& results) {
    require_pointer(ghosts, "ghosts");
    results.prepare_lists();
    *ghosts = results.held() - results.count();
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_ghosts(pnpbs_placement placement, int64_t capacity,
                                        double* coordinates, int64_t* ids, int32_t* tags,
                                        double* spacing, int32_t* owners) {
  return collective_results(placement, [&](NodalResults& results) {
    results.prepare_lists();
    const std::int64_t owned = results.count(), ghosts = results.held() - owned;
    require_capacity(capacity, ghosts);
    copy_nodes(results, owned, ghosts, coordinates, ids, tags, spacing);
    visit_dimension(results, [&](const auto& in) {
      for (std::int64_t g = 0; owners && g < ghosts; ++g)
        owners[g] = in.owner_of(results.node_at(owned + g));
    });
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_adjacency_size(pnpbs_placement placement, int64_t* entries) {
  return collective_results(placement, [&](NodalResults& results) {
    require_pointer(entries, "entries");
    results.prepare_lists();
    *entries = visit_dimension(results, [](const auto& in) { return adjacency_entries(in); });
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_adjacency(pnpbs_placement placement, int64_t capacity,
                                           int64_t* offsets, int64_t* neighbours) {
  return collective_results(placement, [&](NodalResults& results) {
    require_pointer(offsets, "offsets");
    results.prepare_lists();
    return visit_dimension(results, [&](const auto& in) {
      require_capacity(capacity, adjacency_entries(in));
      if (capacity > 0) require_pointer(neighbours, "neighbours");
      std::int64_t at = 0;
      const std::int64_t owned = results.count();
      for (std::int64_t place = 0; place < owned; ++place) {
        offsets[place] = at;
        in.level().lists().for_neighbours(results.node_at(place), [&](std::int64_t j) {
          neighbours[at++] = results.place_of(j);
        });
      }
      offsets[owned] = at;
      return PNPBS_OK;
    });
  });
}

pnpbs_status pnpbs_placement_star_size(pnpbs_placement placement, int64_t* entries) {
  return collective_results(placement, [&](NodalResults& results) {
    require_pointer(entries, "entries");
    results.prepare_stars();
    *entries = visit_dimension(results, [](const auto& in) { return star_entries(in); });
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_stars(pnpbs_placement placement, int64_t capacity,
                                       int64_t* offsets, int64_t* neighbours, int8_t* triangle) {
  return collective_results(placement, [&](NodalResults& results) {
    require_pointer(offsets, "offsets");
    results.prepare_stars();
    return visit_dimension(results, [&](const auto& in) {
      require_capacity(capacity, star_entries(in));
      if (capacity > 0) require_pointer(neighbours, "neighbours");
      std::int64_t at = 0;
      const std::int64_t owned = results.count();
      for (std::int64_t place = 0; place < owned; ++place) {
        offsets[place] = at;
        for_star(in, results.node_at(place), [&](std::int64_t j, bool is_triangle) {
          if (triangle) triangle[at] = is_triangle;
          neighbours[at++] = results.place_of(j);
        });
      }
      offsets[owned] = at;
      return PNPBS_OK;
    });
  });
}

namespace {

// Copies the corner indices of all elements of this rank. Collective.
template <int Dim>
pnpbs_status get_elements(pnpbs_placement placement, std::int64_t capacity, std::int64_t* count,
                          std::int64_t* elements) {
  return collective_results(placement, [&](NodalResults& results) {
    require_pointer(count, "count");
    if (Dim == 3 && results.kind() == GeometryKind::sphere) {  // it has no tetrahedra
      *count = 0;
      return PNPBS_OK;
    }
    const Results<Dim>& in = require_dimension<Dim>(results);
    results.prepare_stars();
    *count = 0;
    in.for_elements([&](const auto&) { ++*count; });
    if (capacity == 0 && !elements) return PNPBS_OK;
    require_capacity(capacity, *count);
    if (!elements) return PNPBS_OK;
    std::int64_t* next = elements;
    in.for_elements(
        [&](const auto& places) { next = std::copy(places.begin(), places.end(), next); });
    return PNPBS_OK;
  });
}

template <int Dim>
pnpbs_status copy_boundary_facets(const Results<Dim>& in, std::int64_t capacity,
                                  std::int64_t* count, std::int64_t* facets, std::int32_t* tags) {
  *count = 0;
  in.for_boundary_facets([&](const auto&, std::int32_t) { ++*count; });
  if (capacity == 0 && !facets && !tags) return PNPBS_OK;
  require_capacity(capacity, *count);
  std::int64_t at = 0;
  in.for_boundary_facets([&](const auto& places, std::int32_t tag) {
    if (facets) std::copy(places.begin(), places.end(), facets + Dim * at);
    if (tags) tags[at] = tag;
    ++at;
  });
  return PNPBS_OK;
}

// Copies the triangles of a sphere and the tags of their regions. On a sphere they are returned as
// its surface, like the triangles of surfaces alone.
pnpbs_status copy_triangles_of_sphere(NodalResults& results, std::int64_t capacity,
                                      std::int64_t* count, std::int64_t* triangles,
                                      std::int32_t* tags) {
  const Results<2>& in = require_dimension<2>(results);
  results.prepare_stars();
  in.for_elements([&](const auto&) { ++*count; });
  if (capacity == 0 && !triangles && !tags) return PNPBS_OK;
  require_capacity(capacity, *count);
  ElementRegions<2> region_of(in);
  in.for_elements([&](const auto& places) {
    if (triangles) triangles = std::copy(places.begin(), places.end(), triangles);
    if (tags) *tags++ = region_of(places);
  });
  return PNPBS_OK;
}

}  // namespace

pnpbs_status pnpbs_placement_get_triangles(pnpbs_placement placement, int64_t capacity,
                                           int64_t* count, int64_t* triangles) {
  return get_elements<2>(placement, capacity, count, triangles);
}

pnpbs_status pnpbs_placement_get_tetrahedra(pnpbs_placement placement, int64_t capacity,
                                            int64_t* count, int64_t* tetrahedra) {
  return get_elements<3>(placement, capacity, count, tetrahedra);
}

pnpbs_status pnpbs_placement_get_element_tags(pnpbs_placement placement, int64_t capacity,
                                              int64_t* count, int32_t* tags) {
  return collective_results(placement, [&](NodalResults& results) {
    require_pointer(count, "count");
    require_inside(results);
    results.prepare_stars();
    pnpbs::visit_dimension(results, [&]<int Dim>(const Results<Dim>& in) {
      *count = 0;
      in.for_elements([&](const auto&) { ++*count; });
      if (capacity == 0 && !tags) return;
      require_capacity(capacity, *count);
      ElementRegions<Dim> region_of(in);
      std::int32_t* next = tags;
      if (tags) in.for_elements([&](const auto& places) { *next++ = region_of(places); });
    });
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_edges(pnpbs_placement placement, int64_t capacity, int64_t* count,
                                       int64_t* straight, int64_t* ends, int64_t* numbers,
                                       double* midpoints) {
  return collective_results(placement, [&](NodalResults& results) {
    require_pointer(count, "count");
    const MidNodes& mids =
        visit_dimension(results, [](auto& in) -> const MidNodes& { return in.mid_nodes(); });
    *count = std::ssize(mids.nodes());
    if (straight) *straight = mids.straight();
    if (capacity == 0 && !ends && !numbers && !midpoints) return PNPBS_OK;
    require_capacity(capacity, *count);
    for (const MidNode& mid : mids.nodes()) {
      if (ends) ends = std::copy(mid.ends.begin(), mid.ends.end(), ends);
      if (numbers) *numbers++ = mid.number;
      if (midpoints) midpoints = std::copy_n(mid.x.begin(), results.coordinates(), midpoints);
    }
    return PNPBS_OK;
  });
}

namespace {

void require_local_indices(const std::int64_t* cells, std::int64_t n, std::int64_t corners,
                           std::int64_t held) {
  for (std::int64_t k = 0; k < n * corners; ++k)
    if (cells[k] < 0 || cells[k] >= held)
      throw Error(ErrorKind::argument, "argument cells[" + std::to_string(k / corners) + "] has " +
                                           std::to_string(cells[k]) + ", expected 0 to " +
                                           std::to_string(held - 1));
}

template <std::size_t corners>
void find_edges(const MidNodes& mids, std::int64_t n, const std::int64_t* cells,
                std::int64_t* edges) {
  for (std::int64_t cell = 0; cell < n; ++cell) {
    std::array<std::int64_t, corners> places;
    std::copy_n(cells + static_cast<std::int64_t>(corners) * cell, corners, places.begin());
    const auto found = mids.of(places);
    edges = std::copy(found.begin(), found.end(), edges);
  }
}

}  // namespace

pnpbs_status pnpbs_placement_find_edges(pnpbs_placement placement, int64_t n, int32_t corners,
                                        const int64_t* cells, int64_t* edges) {
  return collective_results(placement, [&](NodalResults& results) {
    require_count(n, "n");
    if (corners < 2 || corners > 4)
      throw Error(ErrorKind::argument,
                  "argument corners = " + std::to_string(corners) + "; 2, 3 or 4 was expected");
    if (n > 0) require_pointer(cells, "cells");
    if (n > 0) require_pointer(edges, "edges");
    const MidNodes& mids =
        visit_dimension(results, [](auto& in) -> const MidNodes& { return in.mid_nodes(); });
    require_local_indices(cells, n, corners, results.held());
    if (corners == 2) find_edges<2>(mids, n, cells, edges);
    if (corners == 3) find_edges<3>(mids, n, cells, edges);
    if (corners == 4) find_edges<4>(mids, n, cells, edges);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_boundary_edges(pnpbs_placement placement, int64_t capacity,
                                                int64_t* count, int64_t* edges, int32_t* tags) {
  return guarded(placement, [&](PlacementObject& object) {
    require_pointer(count, "count");
    *count = 0;
    NodalResults& results = object.placement->results();
    const Results<2>& in = require_dimension<2>(results);
    if (!results.has_nodes()) return PNPBS_OK;
    results.prepare_order();
    return copy_boundary_facets(in, capacity, count, edges, tags);
  });
}

pnpbs_status pnpbs_placement_get_boundary_triangles(pnpbs_placement placement, int64_t capacity,
                                                    int64_t* count, int64_t* triangles,
                                                    int32_t* tags) {
  return collective_results(placement, [&](NodalResults& results) {
    require_pointer(count, "count");
    *count = 0;
    if (results.kind() == GeometryKind::sphere)
      return copy_triangles_of_sphere(results, capacity, count, triangles, tags);
    const Results<3>& in = require_dimension<3>(results);
    results.prepare_stars();
    return copy_boundary_facets(in, capacity, count, triangles, tags);
  });
}

pnpbs_status pnpbs_placement_check(pnpbs_placement placement) {
  std::optional<MessageText> lacking;
  const pnpbs_status status = collective_results(placement, [&](NodalResults& results) {
    visit_dimension(results, [&](auto& in) { lacking = check_results(in); });
    return PNPBS_OK;
  });
  if (status != PNPBS_OK || !lacking) return status;
  return guarded(placement, [&](PlacementObject& object) {
    thread_error() =
        object.context->last_error = {in_degrees(sphere_of(object), as_worded(*lacking))};
    return PNPBS_NOT_CONFORMING;
  });
}
