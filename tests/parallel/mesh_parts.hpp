// SPDX-License-Identifier: BSD-3-Clause
// Placements in the plane, in space and on surfaces, and a rank's part of a mesh as returned by the
// public interface.
#pragma once

#include <cstdint>
#include <vector>

extern "C" {
#include "rank_program.h"
}
#include "volume_cases.h"

namespace {

using Ids = std::vector<std::int64_t>;

// ------------------------------------------------------------------ cases ----------------------

// Adds the unit square with a hole, and an inner curve that ends in the hole. Some tags have no
// names, and one is negative, which other programs cannot represent.
inline pnpbs_status plane_with_curve(pnpbs_domain domain, const char*) {
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1},
               hole[] = {0.2, 0.2, 0.2, 0.4, 0.4, 0.4, 0.4, 0.2},
               curve[] = {0.5, 0.3, 0.7, 0.6, 0.6, 0.9};
  const std::int32_t of_square[] = {5, 5, 5, 5}, of_hole[] = {-6, -6, -6, -6}, of_curve[] = {7, 7};
  pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square, of_square, 0);
  pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, hole, of_hole, 0);
  pnpbs_domain_set_tag_name(domain, 1, 5, "outline");
  pnpbs_domain_set_tag_name(domain, 2, 3, "water");
  return pnpbs_domain_add_polyline(domain, PNPBS_INNER, 0, 3, curve, of_curve, 0);
}

// Adds a box, and a wall inside that touches nothing.
constexpr std::int32_t kWall = 2;
inline pnpbs_status walled_box(pnpbs_domain domain, const char*) {
  const double low[] = {0, 0, 0}, high[] = {2, 1, 1};
  const double wall[4][3] = {{1, 0.2, 0.2}, {1, 0.8, 0.2}, {1, 0.8, 0.8}, {1, 0.2, 0.8}};
  const std::int64_t triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
  const std::int32_t tags[] = {kWall, kWall};
  const pnpbs_status status = pnpbs_domain_add_box(domain, low, high, 1);
  return status < 0
             ? status
             : pnpbs_domain_add_surface(domain, PNPBS_INNER, 4, wall[0], 2, triangles[0], tags, 40);
}

struct Case {
  const char* name;
  std::int32_t dim;
  volume_body body;
  double d;
};
const Case kCases[] = {{"plane", 2, plane_with_curve, 0.04},
                       {"walled box", 3, walled_box, 0.17},
                       {"few nodes", 3, volume_unit_box, 0.5},
                       {"closed surface", 3, surface_halves, 0.2},
                       {"open surface", 3, surface_terrain, 0.15}};

inline pnpbs_placement placed(const Case& it, pnpbs_context in) {
  pnpbs_domain domain;
  pnpbs_placement placement;
  expect(pnpbs_domain_create(in, it.dim, &domain) == PNPBS_OK, "domain");
  expect(it.body(domain, nullptr) >= 0, "body");
  expect(pnpbs_placement_create(in, domain, &placement) == PNPBS_OK, "placement");
  pnpbs_placement_set_int64(placement, "steps", 20);
  pnpbs_placement_set_spacing_constant(placement, it.d);
  expect(pnpbs_placement_run(placement) >= 0, "run");
  pnpbs_domain_destroy(&domain);
  return placement;
}

// ------------------------------------------------------------------ this rank's part -----------

struct Part {
  std::int32_t dim = 0, corners = 0;
  std::int64_t owned_nodes = 0, nodes = 0, owned_elements = 0, elements = 0, facets = 0;
  std::int64_t first_node = 0, all_nodes = 0, first_element = 0, all_elements = 0;
  std::int64_t shared = 0, entries = 0;
  std::vector<double> x;
  Ids numbers, ids, element_numbers, connectivity, sharing_offsets;
  std::vector<std::int32_t> owners, tags, element_nodes, element_owners, element_tags,
      connectivity32, facet_nodes, facet_tags, facet_elements, facet_opposite, facet_owners,
      shared_nodes, sharing_ranks;
  std::vector<std::int8_t> facet_inner;

  Ids ids_of(const std::vector<std::int32_t>& rows, std::int64_t row, std::int32_t width) const {
    Ids of;
    for (std::int64_t k = row * width; k < (row + 1) * width; ++k)
      of.push_back(ids[static_cast<std::size_t>(rows[static_cast<std::size_t>(k)])]);
    return of;
  }
  Ids element(std::int64_t e) const { return ids_of(element_nodes, e, corners); }
  Ids facet(std::int64_t f) const { return ids_of(facet_nodes, f, corners - 1); }
};

template <class Array>
auto* room(Array& array, std::int64_t n) {
  array.resize(static_cast<std::size_t>(n) + 1);  // one more, so that the pointer is never null
  return array.data();
}

inline Part part_of(pnpbs_mesh mesh) {
  Part p;
  expect(pnpbs_mesh_sizes(mesh, &p.dim, &p.corners, &p.owned_nodes, &p.nodes, &p.owned_elements,
                          &p.elements, &p.facets) == PNPBS_OK,
         "sizes");
  expect(pnpbs_mesh_numbering(mesh, &p.first_node, &p.all_nodes, &p.first_element,
                              &p.all_elements) == PNPBS_OK,
         "numbering");
  expect(pnpbs_mesh_get_nodes(mesh, p.nodes, room(p.x, p.nodes * p.dim), room(p.numbers, p.nodes),
                              room(p.ids, p.nodes), room(p.owners, p.nodes),
                              room(p.tags, p.nodes)) == PNPBS_OK,
         "nodes");
  const std::int64_t corners = p.elements * p.corners;
  expect(pnpbs_mesh_get_elements(
             mesh, p.elements, room(p.element_nodes, corners), room(p.element_numbers, p.elements),
             room(p.element_owners, p.elements), room(p.element_tags, p.elements)) == PNPBS_OK,
         "elements");
  expect(pnpbs_mesh_get_connectivity(mesh, p.elements, room(p.connectivity, corners)) == PNPBS_OK,
         "connectivity");
  expect(pnpbs_mesh_get_connectivity_int32(mesh, p.elements, room(p.connectivity32, corners)) ==
             PNPBS_OK,
         "connectivity in 32 bits");
  expect(pnpbs_mesh_get_facets(mesh, p.facets, room(p.facet_nodes, p.facets * (p.corners - 1)),
                               room(p.facet_tags, p.facets), room(p.facet_elements, 2 * p.facets),
                               room(p.facet_opposite, p.facets), room(p.facet_inner, p.facets),
                               room(p.facet_owners, p.facets)) == PNPBS_OK,
         "facets");
  expect(pnpbs_mesh_sharing_sizes(mesh, &p.shared, &p.entries) == PNPBS_OK, "sharing");
  expect(pnpbs_mesh_get_sharing(mesh, p.shared, p.entries, room(p.shared_nodes, p.shared),
                                room(p.sharing_offsets, p.shared + 1),
                                room(p.sharing_ranks, p.entries)) == PNPBS_OK,
         "who shares");
  return p;
}

// ------------------------------------------------------------------ over all ranks -------------

inline Ids gathered(const Ids& mine) {
  int n = static_cast<int>(mine.size());
  std::vector<int> sizes(static_cast<std::size_t>(size)), at(sizes.size() + 1, 0);
  MPI_Allgather(&n, 1, MPI_INT, sizes.data(), 1, MPI_INT, group);
  for (std::size_t r = 0; r < sizes.size(); ++r) at[r + 1] = at[r] + sizes[r];
  Ids all(static_cast<std::size_t>(at.back()) + 1);
  MPI_Allgatherv(mine.data(), n, MPI_INT64_T, all.data(), sizes.data(), at.data(), MPI_INT64_T,
                 group);
  all.pop_back();
  return all;
}

}  // namespace
