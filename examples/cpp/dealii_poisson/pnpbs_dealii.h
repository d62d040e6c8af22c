// SPDX-License-Identifier: BSD-3-Clause
//
// Converts a distributed mesh of PNPBS into a parallel::fullydistributed::Triangulation of deal.II.
// The header is self-contained: copy it next to your program. It requires C++17 and deal.II 9.4 or
// later with MPI.
#ifndef PNPBS_DEALII_H
#define PNPBS_DEALII_H

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/partitioner.h>
#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/grid/tria_description.h>
#include <pnpbs/pnpbs.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace pnpbs_dealii {

/** Throws std::runtime_error with the message of the last error if the status is one. Positive
 *  statuses are accepted. Local. */
inline void check(pnpbs_status status) {
  if (status < 0) throw std::runtime_error(std::string("PNPBS: ") + pnpbs_last_error(nullptr));
}

/** A map between the nodes of a placement and the vertices of a triangulation. A
 *  LinearAlgebra::distributed::Vector on `partitioner` holds a field: its locally owned elements
 * are the values at the nodes that this rank owns, in the order of pnpbs_placement_get_nodes, and
 * its ghosts are the values at the other vertices on this rank. update_ghost_values sends a field
 * from the nodes to the vertices, and compress sends it back. */
struct NodeMap {
  std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;

  /** [n_vertices] The global number of the node at each vertex, which is an index of such a vector,
   *  or numbers::invalid_dof_index if the vertex does not belong to the mesh. */
  std::vector<dealii::types::global_dof_index> number_at_vertex;
};

/** Boundary id of the faces inside the mesh where the ghost cells of a rank end. deal.II treats
 * them as boundary faces of the ghost cells, so a loop over all boundary ids must skip this one. */
constexpr dealii::types::boundary_id end_of_ghosts = dealii::numbers::invalid_boundary_id - 1;

namespace internal {

/** A copy of the arrays of a mesh, as documented at the functions pnpbs_mesh_get_... in pnpbs.h. */
struct Mesh {
  int32_t dim = 0, corners = 0;
  int64_t owned_nodes = 0, nodes = 0, owned_elements = 0, elements = 0, facets = 0;
  int64_t first_node = 0, all_nodes = 0, shared_nodes = 0;
  std::vector<double> coordinates;
  std::vector<int64_t> node_numbers, element_numbers;
  std::vector<int32_t> corner_nodes, element_owners, element_tags;
  std::vector<int32_t> facet_nodes, facet_tags, facet_elements;
  std::vector<int8_t> facet_inner;

  explicit Mesh(pnpbs_mesh mesh) {
    check(pnpbs_mesh_sizes(mesh, &dim, &corners, &owned_nodes, &nodes, &owned_elements, &elements,
                           &facets));
    check(pnpbs_mesh_numbering(mesh, &first_node, &all_nodes, nullptr, nullptr));
    check(pnpbs_mesh_sharing_sizes(mesh, &shared_nodes, nullptr));
    coordinates.resize(dim * nodes);
    node_numbers.resize(nodes);
    check(pnpbs_mesh_get_nodes(mesh, nodes, coordinates.data(), node_numbers.data(), nullptr,
                               nullptr, nullptr));
    corner_nodes.resize(corners * elements);
    element_numbers.resize(elements);
    element_owners.resize(elements);
    element_tags.resize(elements);
    check(pnpbs_mesh_get_elements(mesh, elements, corner_nodes.data(), element_numbers.data(),
                                  element_owners.data(), element_tags.data()));
    facet_nodes.resize((corners - 1) * facets);
    facet_tags.resize(facets);
    facet_elements.resize(2 * facets);
    facet_inner.resize(facets);
    check(pnpbs_mesh_get_facets(mesh, facets, facet_nodes.data(), facet_tags.data(),
                                facet_elements.data(), nullptr, facet_inner.data(), nullptr));
  }

  /** Returns [elements] the cell index of each element, or -1. deal.II requires the owned elements
   *  and those that share a node with them as cells. */
  std::vector<int64_t> cells() const {
    std::vector<char> touched(nodes, 0);
    std::vector<int64_t> cell_of(elements, -1);
    for (int64_t i = 0; i < corners * owned_elements; ++i) touched[corner_nodes[i]] = 1;
    for (int64_t e = 0, count = 0; e < elements; ++e) {
      const int32_t* const corner = &corner_nodes[corners * e];
      if (std::any_of(corner, corner + corners, [&](int32_t node) { return touched[node]; }))
        cell_of[e] = count++;
    }
    return cell_of;
  }

  /** Calls function(facet, cell, face) for the facets of cells that are inner or not, as `inner`
   *  says. `face` is deal.II's number of the face in the cell. */
  template <typename Function>
  void for_facets(const std::vector<int64_t>& cell_of, bool inner, Function function) const {
    for (int64_t i = 0; i < 2 * facets; ++i) {
      const int64_t facet = i / 2, element = facet_elements[i];
      if ((facet_inner[facet] != 0) != inner || element < 0 || cell_of[element] < 0) continue;
      const int32_t* const corner = &corner_nodes[corners * element];
      const int32_t* const begin = &facet_nodes[(corners - 1) * facet];
      const int32_t* const end = begin + corners - 1;
      unsigned int opposite = 0;
      while (std::find(begin, end, corner[opposite]) != end) ++opposite;
      function(facet, cell_of[element], corners == 3 ? (opposite + 1) % 3 : 3 - opposite);
    }
  }
};

/** Throws on all ranks if the mesh has no ghost layer. This is the case if ranks share nodes but no
 * rank has ghost elements. Collective. */
inline void check_ghosts(const Mesh& mesh, MPI_Comm comm) {
  const bool ghosts = mesh.elements > mesh.owned_elements, shares = mesh.shared_nodes > 0;
  if (dealii::Utilities::MPI::max(shares ? 1 : 0, comm) == 1 &&
      dealii::Utilities::MPI::max(ghosts ? 1 : 0, comm) == 0)
    throw std::runtime_error("deal.II needs a mesh with a ghost layer");
}

/** Converts a tag to an id, which is unsigned in deal.II. Throws std::runtime_error if it is
 * negative. */
inline unsigned int id_of_tag(int32_t tag) {
  if (tag < 0)
    throw std::runtime_error("deal.II has no negative ids, and the mesh has a tag below 0");
  return static_cast<unsigned int>(tag);
}

/** Adds a cell without boundary ids to the description. */
template <int dim, int spacedim>
void add_cell(const dealii::CellData<dim>& corners, dealii::types::coarse_cell_id id,
              dealii::types::subdomain_id owner,
              dealii::TriangulationDescription::Description<dim, spacedim>& description) {
  dealii::TriangulationDescription::CellData<dim> info;
  info.id = dealii::CellId(id, {}).template to_binary<dim>();
  info.subdomain_id = info.level_subdomain_id = owner;
  info.manifold_id = dealii::numbers::flat_manifold_id;
  info.manifold_line_ids.fill(dealii::numbers::flat_manifold_id);
  info.manifold_quad_ids.fill(dealii::numbers::flat_manifold_id);
  description.coarse_cells.push_back(corners);
  description.coarse_cell_index_to_coarse_cell_id.push_back(id);
  description.cell_infos[0].push_back(info);
}

/** Adds the cells of this rank and their vertices to the description. vertex_at[node] becomes the
 * vertex of each node, or -1. */
template <int dim, int spacedim>
void add_elements(const Mesh& mesh, const std::vector<int64_t>& cell_of,
                  dealii::TriangulationDescription::Description<dim, spacedim>& description,
                  std::vector<int64_t>& vertex_at) {
  vertex_at.assign(mesh.nodes, -1);
  for (int64_t e = 0; e < mesh.elements; ++e) {
    if (cell_of[e] < 0) continue;
    dealii::CellData<dim> cell(dim + 1);
    cell.material_id = id_of_tag(mesh.element_tags[e]);
    for (int k = 0; k <= dim; ++k) {
      const int32_t node = mesh.corner_nodes[(dim + 1) * e + k];
      if (vertex_at[node] < 0) {
        dealii::Point<spacedim> x;
        for (int c = 0; c < spacedim; ++c) x[c] = mesh.coordinates[spacedim * node + c];
        vertex_at[node] = description.coarse_cell_vertices.size();
        description.coarse_cell_vertices.push_back(x);
      }
      cell.vertices[k] = vertex_at[node];
    }
    add_cell(cell, mesh.element_numbers[e], mesh.element_owners[e], description);
    // deal.II uses an id only if the face has no cell on its other side on this rank. This is so
    // where the ghost cells end. If the face is a facet of the mesh, the id of its tag follows and
    // replaces this one.
    if (e >= mesh.owned_elements)
      for (unsigned int face = 0; face <= dim; ++face)
        description.cell_infos[0].back().boundary_ids.emplace_back(face, end_of_ghosts);
  }
}

/** Adds an artificial cell, which is not part of the mesh. deal.II requires a cell also on a rank
 * without elements. */
template <int dim, int spacedim>
void add_artificial_cell(
    dealii::TriangulationDescription::Description<dim, spacedim>& description) {
  dealii::CellData<dim> cell(dim + 1);
  for (int k = 0; k <= dim; ++k) {
    dealii::Point<spacedim> x;
    if (k > 0) x[k - 1] = 1;
    cell.vertices[k] = k;
    description.coarse_cell_vertices.push_back(x);
  }
  add_cell(cell, 0, dealii::numbers::artificial_subdomain_id, description);
}

/** Builds the map between nodes and vertices. Collective. */
inline NodeMap map_nodes(const Mesh& mesh, const std::vector<int64_t>& vertex_at,
                         std::size_t n_vertices, MPI_Comm comm) {
  using dealii::IndexSet;
  NodeMap map;
  IndexSet owned(mesh.all_nodes), ghosts(mesh.all_nodes);
  map.number_at_vertex.assign(n_vertices, dealii::numbers::invalid_dof_index);
  owned.add_range(mesh.first_node, mesh.first_node + mesh.owned_nodes);
  for (int64_t i = 0; i < mesh.nodes; ++i)
    if (vertex_at[i] >= 0) {
      map.number_at_vertex[vertex_at[i]] = mesh.node_numbers[i];
      if (i >= mesh.owned_nodes) ghosts.add_index(mesh.node_numbers[i]);
    }
  map.partitioner = std::make_shared<dealii::Utilities::MPI::Partitioner>(owned, ghosts, comm);
  return map;
}

}  // namespace internal

/** Creates a triangulation whose cells on each rank are the elements that the rank owns, and as
 *  ghost cells the elements of other ranks that share a node with them. Nothing is gathered, read
 *  from a file or partitioned. The id of a coarse cell is the number of the element. All data are
 *  copied, so the mesh may be destroyed afterwards. Boundary ids are the tags of boundary facets.
 *  Inner faces have no boundary ids in deal.II; those on inner curves or surfaces have the tag as
 *  user index. Faces where the ghost cells end have the id end_of_ghosts. Material ids are the tags
 *  of the elements. Collective.
 *  Throws std::runtime_error for an error of PNPBS, a mesh of other dimensions, a mesh without
 * ghost layers on several ranks, negative tags, and more nodes than types::global_dof_index can
 * number.
 *  @param[in] mesh            a mesh with one ghost layer or more, as created by
 *                             pnpbs_mesh_create(placement, 1, &mesh). On surfaces alone dim is 2
 *                             and spacedim 3
 *  @param[out] triangulation  must be empty, on the communicator of the mesh's context
 *  @return                    the map between nodes and vertices */
template <int dim, int spacedim>
NodeMap make_triangulation(
    pnpbs_mesh mesh,
    dealii::parallel::fullydistributed::Triangulation<dim, spacedim>& triangulation) {
#if DEAL_II_VERSION_GTE(9, 7, 0)
  const MPI_Comm comm = triangulation.get_mpi_communicator();
#else
  const MPI_Comm comm = triangulation.get_communicator();
#endif
  const internal::Mesh arrays(mesh);
  if (arrays.dim != spacedim || arrays.corners != dim + 1)
    throw std::runtime_error("the mesh has other dimensions than the triangulation");
  if (arrays.all_nodes > std::numeric_limits<dealii::types::global_dof_index>::max())
    throw std::runtime_error("the mesh needs a deal.II with 64-bit indices");
  internal::check_ghosts(arrays, comm);

  dealii::TriangulationDescription::Description<dim, spacedim> description;
  description.comm = comm;
  description.settings = dealii::TriangulationDescription::default_setting;
  description.smoothing = dealii::Triangulation<dim, spacedim>::none;
  description.cell_infos.resize(1);
  std::vector<int64_t> vertex_at;
  const std::vector<int64_t> cell_of = arrays.cells();
  internal::add_elements(arrays, cell_of, description, vertex_at);
  arrays.for_facets(cell_of, false, [&](int64_t facet, int64_t cell, unsigned int face) {
    const auto tag = internal::id_of_tag(arrays.facet_tags[facet]);
    description.cell_infos[0][cell].boundary_ids.emplace_back(face, tag);
  });
  if (description.coarse_cells.empty()) internal::add_artificial_cell(description);

  triangulation.create_triangulation(description);
  arrays.for_facets(cell_of, true, [&](int64_t facet, int64_t cell, unsigned int face) {
    const typename dealii::Triangulation<dim, spacedim>::cell_iterator at(&triangulation, 0, cell);
    at->face(face)->set_user_index(internal::id_of_tag(arrays.facet_tags[facet]));
  });
  return internal::map_nodes(arrays, vertex_at, triangulation.n_vertices(), comm);
}

}  // namespace pnpbs_dealii

#endif
