// SPDX-License-Identifier: BSD-3-Clause
//
// Converts a distributed mesh of PNPBS into a ParMesh of MFEM. The header is self-contained: copy
// it next to your program. It requires C++17 and MFEM 4.5 or later with MPI.
#ifndef PNPBS_MFEM_H
#define PNPBS_MFEM_H

#include <mpi.h>
#include <pnpbs/pnpbs.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iomanip>
#include <ios>
#include <limits>
#include <map>
#include <memory>
#include <mfem.hpp>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace pnpbs_mfem {

/** Throws std::runtime_error with the message of the last error if the status is one. Positive
 *  statuses are accepted. Local. */
inline void check(pnpbs_status status) {
  if (status < 0) throw std::runtime_error(std::string("PNPBS: ") + pnpbs_last_error(nullptr));
}

/** A map between the nodes of a placement and the vertices of a mesh. The local values of a
 *  ParGridFunction of linear elements (H1_FECollection of order 1, one component) are those at the
 *  vertices. */
class NodeMap {
 public:
  /** [GetNV()] The global number of the node at each vertex. */
  std::vector<int64_t> number_at_vertex;

  /** Sends a field from the nodes of the placement to the vertices. Collective.
   *  @param[in] at_nodes      values at the nodes that this rank owns, in the order of
   *                           pnpbs_placement_get_nodes
   *  @param[out] at_vertices  [GetNV()] */
  void to_vertices(const double* at_nodes, double* at_vertices) const {
    exchange(node_lists_, at_nodes, vertex_lists_, at_vertices);
  }

  /** Sends a field from the vertices back to the nodes. A vertex that several ranks share must have
   *  the same value on each of them. Collective. The arrays are those of to_vertices. */
  void to_nodes(const double* at_vertices, double* at_nodes) const {
    exchange(vertex_lists_, at_vertices, node_lists_, at_nodes);
  }

 private:
  using Lists = std::map<int, std::vector<int32_t>>;  // key: a rank, also this one

  static void exchange(const Lists& from, const double* values, const Lists& to, double* results,
                       MPI_Comm comm);
  void exchange(const Lists& from, const double* values, const Lists& to, double* results) const {
    exchange(from, values, to, results, comm_);
  }

  MPI_Comm comm_ = MPI_COMM_NULL;
  Lists node_lists_;    // owned nodes that are vertices on the rank
  Lists vertex_lists_;  // vertices whose nodes the rank owns

  friend class Writer;
};

inline void NodeMap::exchange(const Lists& from, const double* values, const Lists& to,
                              double* results, MPI_Comm comm) {
  std::vector<std::vector<double>> sent, received;
  std::vector<MPI_Request> requests;
  const auto size = [](const std::vector<double>& message) {
    return static_cast<int>(message.size());
  };
  for (const auto& [rank, list] : to) {
    received.emplace_back(list.size());
    requests.emplace_back();
    MPI_Irecv(received.back().data(), size(received.back()), MPI_DOUBLE, rank, 0, comm,
              &requests.back());
  }
  for (const auto& [rank, list] : from) {
    sent.emplace_back();
    for (const int32_t i : list) sent.back().push_back(values[i]);
    requests.emplace_back();
    MPI_Isend(sent.back().data(), size(sent.back()), MPI_DOUBLE, rank, 0, comm, &requests.back());
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  auto message = received.begin();
  for (const auto& [rank, list] : to) {
    for (std::size_t k = 0; k < list.size(); ++k) results[list[k]] = (*message)[k];
    ++message;
  }
}

/** The result of make_mesh: the mesh, and the map between nodes and vertices. */
struct DistributedMesh {
  std::unique_ptr<mfem::ParMesh> mesh;
  NodeMap nodes;

  /** The attributes of elements and of boundary elements whose tag is 0. */
  int untagged_attribute, untagged_boundary_attribute;
};

namespace internal {

/** A copy of the arrays of a mesh, as documented at the functions pnpbs_mesh_get_... in pnpbs.h. */
struct Mesh {
  int32_t dim = 0, corners = 0;
  int64_t owned_nodes = 0, nodes = 0, owned_elements = 0, elements = 0, facets = 0;
  int64_t all_nodes = 0, shared_nodes = 0;
  std::vector<double> coordinates;
  std::vector<int64_t> node_numbers;
  std::vector<int32_t> node_owners, corner_nodes, element_owners, element_tags;
  std::vector<int32_t> facet_nodes, facet_tags, facet_elements, facet_owners;

  explicit Mesh(pnpbs_mesh mesh) {
    check(pnpbs_mesh_sizes(mesh, &dim, &corners, &owned_nodes, &nodes, &owned_elements, &elements,
                           &facets));
    check(pnpbs_mesh_numbering(mesh, nullptr, &all_nodes, nullptr, nullptr));
    check(pnpbs_mesh_sharing_sizes(mesh, &shared_nodes, nullptr));
    coordinates.resize(dim * nodes);
    node_numbers.resize(nodes);
    node_owners.resize(nodes);
    check(pnpbs_mesh_get_nodes(mesh, nodes, coordinates.data(), node_numbers.data(), nullptr,
                               node_owners.data(), nullptr));
    corner_nodes.resize(corners * elements);
    element_owners.resize(elements);
    element_tags.resize(elements);
    check(pnpbs_mesh_get_elements(mesh, elements, corner_nodes.data(), nullptr,
                                  element_owners.data(), element_tags.data()));
    facet_nodes.resize((corners - 1) * facets);
    facet_tags.resize(facets);
    facet_elements.resize(2 * facets);
    facet_owners.resize(facets);
    check(pnpbs_mesh_get_facets(mesh, facets, facet_nodes.data(), facet_tags.data(),
                                facet_elements.data(), nullptr, nullptr, facet_owners.data()));
  }

  const int32_t* corners_of(int64_t element) const { return &corner_nodes[corners * element]; }
};

/** The attributes that replace the tag 0, because attributes are positive in MFEM: one more than
 * the largest tag. */
struct Attributes {
  int untagged_element = 0, untagged_facet = 0;
  int facets = 0;  // 1 if any rank has facets

  /** Computes the attributes. Collective. Throws std::runtime_error on all ranks for negative tags
   *  and for the largest 32-bit integer as a tag, which has no successor. */
  Attributes(const Mesh& mesh, MPI_Comm comm) {
    // Largest tags of elements and facets, 1 if a tag is invalid, 1 if this rank has facets.
    int32_t extremes[4] = {0, 0, 0, mesh.facets > 0 ? 1 : 0};
    for (const int32_t tag : mesh.element_tags) {
      extremes[0] = std::max(extremes[0], tag);
      extremes[2] |= is_refused(tag);
    }
    for (const int32_t tag : mesh.facet_tags) {
      extremes[1] = std::max(extremes[1], tag);
      extremes[2] |= is_refused(tag);
    }
    MPI_Allreduce(MPI_IN_PLACE, extremes, 4, MPI_INT32_T, MPI_MAX, comm);
    if (extremes[2] > 0)
      throw std::runtime_error(
          "the mesh has a tag below 0 or of 2147483647: MFEM's attributes are positive, and there "
          "must be one more");
    untagged_element = extremes[0] + 1;
    untagged_facet = extremes[1] + 1;
    facets = extremes[3];
  }

 private:
  static int32_t is_refused(int32_t tag) {
    return tag < 0 || tag == std::numeric_limits<int32_t>::max();
  }
};

/** A vertex, edge or face, as the increasing numbers of its nodes, padded with -1. */
using Entity = std::array<int64_t, 3>;

/** The entities that one set of ranks shares: vertices, edges and faces. */
using Group = std::array<std::vector<Entity>, 3>;

/** Throws on all ranks if the mesh has no ghost layer. This is the case if ranks share nodes but no
 * rank has ghost elements. Collective. */
inline void check_ghosts(const Mesh& mesh, MPI_Comm comm) {
  int there[2] = {mesh.shared_nodes > 0, mesh.elements > mesh.owned_elements};
  MPI_Allreduce(MPI_IN_PLACE, there, 2, MPI_INT, MPI_MAX, comm);
  if (there[0] != 0 && there[1] == 0)
    throw std::runtime_error("MFEM's groups of ranks need a mesh with a ghost layer");
}

}  // namespace internal

/** A writer of the part of this rank in MFEM's format of parallel meshes, which also builds the map
 * between nodes and vertices. */
class Writer {
 public:
  /** Copies the mesh and finds the shared entities. Collective. Throws as make_mesh. */
  Writer(pnpbs_mesh mesh, MPI_Comm comm) : comm_(comm), mesh_(mesh), attributes_(mesh_, comm) {
    internal::check_ghosts(mesh_, comm);
    MPI_Comm_rank(comm, &rank_);
    vertex_at_.assign(mesh_.nodes, -1);
    for (int64_t i = 0; i < mesh_.corners * mesh_.owned_elements; ++i)
      vertex_at_[mesh_.corner_nodes[i]] = 0;
    for (int64_t i = 0; i < mesh_.nodes; ++i)
      if (vertex_at_[i] == 0) {
        vertex_at_[i] = static_cast<int32_t>(node_at_.size());
        node_at_.push_back(static_cast<int32_t>(i));
      }
    for (int32_t corners = 1; corners < mesh_.corners; ++corners) find_shared(corners);
  }

  const internal::Attributes& attributes() const { return attributes_; }

  /** Writes the part of this rank. Local. */
  void write(std::ostream& out) const {
    out << "MFEM mesh v1.2\n\ndimension\n" << mesh_.corners - 1 << '\n';
    write_elements(out);
    write_boundary(out);
    write_vertices(out);
    out << "\nmfem_serial_mesh_end\n";
    write_groups(out);
  }

  /** Returns the map between nodes and vertices. Local. */
  NodeMap nodes() const {
    NodeMap map;
    map.comm_ = comm_;
    for (std::size_t v = 0; v < node_at_.size(); ++v) {
      map.number_at_vertex.push_back(mesh_.node_numbers[node_at_[v]]);
      map.vertex_lists_[mesh_.node_owners[node_at_[v]]].push_back(static_cast<int32_t>(v));
    }
    std::vector<std::pair<int32_t, int32_t>> at;  // (rank, owned node that is a vertex there)
    for (int64_t e = 0; e < mesh_.elements; ++e)
      for (int32_t k = 0; k < mesh_.corners; ++k)
        if (mesh_.corners_of(e)[k] < mesh_.owned_nodes)
          at.emplace_back(mesh_.element_owners[e], mesh_.corners_of(e)[k]);
    std::sort(at.begin(), at.end());
    at.erase(std::unique(at.begin(), at.end()), at.end());
    for (const auto& [rank, node] : at) map.node_lists_[rank].push_back(node);
    return map;
  }

 private:
  /** Returns MFEM's number of the simplex with so many corners. */
  static int geometry(int32_t corners) {
    return corners == 2 ? mfem::Geometry::SEGMENT
                        : (corners == 3 ? mfem::Geometry::TRIANGLE : mfem::Geometry::TETRAHEDRON);
  }

  void write_elements(std::ostream& out) const {
    out << "\nelements\n" << mesh_.owned_elements << '\n';
    for (int64_t e = 0; e < mesh_.owned_elements; ++e) {
      const int32_t tag = mesh_.element_tags[e];
      out << (tag == 0 ? attributes_.untagged_element : tag) << ' ' << geometry(mesh_.corners);
      for (int32_t k = 0; k < mesh_.corners; ++k) out << ' ' << vertex_at_[mesh_.corners_of(e)[k]];
      out << '\n';
    }
  }

  /** Writes the vertices of a facet with the orientation of its owned element: a boundary triangle
   *  of a body is counter-clockwise as seen from outside. */
  void write_facet(int64_t facet, std::ostream& out) const {
    static const int sides[2][4][3] = {{{1, 2, -1}, {2, 0, -1}, {0, 1, -1}, {}},
                                       {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
    const int32_t n = mesh_.corners - 1;
    const int32_t* const begin = &mesh_.facet_nodes[n * facet];
    const int32_t* const of_facet = &mesh_.facet_elements[2 * facet];
    const int32_t* const corner =
        mesh_.corners_of(of_facet[0] < mesh_.owned_elements ? of_facet[0] : of_facet[1]);
    int opposite = 0;
    while (std::find(begin, begin + n, corner[opposite]) != begin + n) ++opposite;
    for (int32_t k = 0; k < n; ++k) out << ' ' << vertex_at_[corner[sides[n - 2][opposite][k]]];
  }

  void write_boundary(std::ostream& out) const {
    const auto mine = [&](int32_t owner) { return owner == rank_; };
    out << "\nboundary\n"
        << std::count_if(mesh_.facet_owners.begin(), mesh_.facet_owners.end(), mine) << '\n';
    for (int64_t f = 0; f < mesh_.facets; ++f) {
      if (!mine(mesh_.facet_owners[f])) continue;
      const int32_t tag = mesh_.facet_tags[f];
      out << (tag == 0 ? attributes_.untagged_facet : tag) << ' ' << geometry(mesh_.corners - 1);
      write_facet(f, out);
      out << '\n';
    }
  }

  void write_vertices(std::ostream& out) const {
    out << "\nvertices\n" << node_at_.size() << '\n' << mesh_.dim << '\n';
    const auto precision = out.precision(std::numeric_limits<double>::max_digits10);
    for (const int32_t node : node_at_)
      for (int32_t c = 0; c < mesh_.dim; ++c)
        out << mesh_.coordinates[mesh_.dim * node + c] << (c + 1 < mesh_.dim ? ' ' : '\n');
    out.precision(precision);
  }

  /** Finds the entities with so many corners (1: vertices, 2: edges, 3: faces) that this rank
   * shares with others, from its ghost elements, and adds them to the groups. */
  void find_shared(int32_t corners) {
    std::vector<std::pair<internal::Entity, int32_t>> found;  // (entity, rank with an element)
    std::vector<char> of_ghosts(mesh_.nodes, 0);
    for (int64_t i = mesh_.corners * mesh_.owned_elements; i < mesh_.corners * mesh_.elements; ++i)
      of_ghosts[mesh_.corner_nodes[i]] = 1;
    for (int64_t e = 0; e < mesh_.elements; ++e)
      for (unsigned int subset = 1; subset < (1U << mesh_.corners); ++subset) {
        internal::Entity entity = {-1, -1, -1};
        int32_t n = 0;
        for (int32_t k = 0; k < mesh_.corners; ++k) {
          const int32_t node = mesh_.corners_of(e)[k];
          if ((subset >> k & 1U) == 0) continue;
          if (n == corners || of_ghosts[node] == 0 || vertex_at_[node] < 0) {
            n = -1;
            break;
          }
          int32_t place = n++;
          for (; place > 0 && entity[place - 1] > mesh_.node_numbers[node]; --place)
            entity[place] = entity[place - 1];
          entity[place] = mesh_.node_numbers[node];
        }
        if (n != corners) continue;
        found.emplace_back(entity, mesh_.element_owners[e]);
      }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    for (auto begin = found.begin(); begin != found.end();) {
      std::vector<int32_t> ranks;
      auto end = begin;
      for (; end != found.end() && end->first == begin->first; ++end) ranks.push_back(end->second);
      if (ranks.size() > 1 && std::find(ranks.begin(), ranks.end(), rank_) != ranks.end())
        groups_[ranks][corners - 1].push_back(begin->first);
      begin = end;
    }
  }

  void write_groups(std::ostream& out) const {
    static const char* const names[] = {"vertices", "edges", "faces"};
    std::map<int64_t, int32_t> vertex_with;
    for (std::size_t v = 0; v < node_at_.size(); ++v)
      vertex_with[mesh_.node_numbers[node_at_[v]]] = static_cast<int32_t>(v);
    out << "\ncommunication_groups\nnumber_of_groups " << groups_.size() + 1 << "\n\n1 " << rank_
        << '\n';
    for (const auto& [ranks, group] : groups_) {
      out << ranks.size();
      for (const int32_t rank : ranks) out << ' ' << rank;
      out << '\n';
    }
    out << '\n';
    for (int32_t d = 0; d < mesh_.corners - 1; ++d) {
      std::size_t total = 0;
      for (const auto& [ranks, group] : groups_) total += group[d].size();
      out << "total_shared_" << names[d] << ' ' << total << '\n';
    }
    for (const auto& [ranks, group] : groups_)
      for (int32_t d = 0; d < mesh_.corners - 1; ++d) {
        out << "\nshared_" << names[d] << ' ' << group[d].size() << '\n';
        for (const internal::Entity& entity : group[d]) {
          if (d == 2) out << geometry(3) << ' ';
          for (int32_t k = 0; k <= d; ++k) out << vertex_with.at(entity[k]) << (k < d ? ' ' : '\n');
        }
      }
  }

  MPI_Comm comm_;
  int rank_ = 0;
  internal::Mesh mesh_;
  internal::Attributes attributes_;
  std::vector<int32_t> vertex_at_;  // [nodes] the vertex of each node, or -1
  std::vector<int32_t> node_at_;    // [vertices] local index of each node, increasing
  std::map<std::vector<int32_t>, internal::Group> groups_;  // key: the ranks that share them
};

/** Writes the part of this rank in MFEM's format of parallel meshes ("MFEM mesh v1.2"), for example
 *  into the file mesh.000003 on rank 3. ParMesh and GLVis read it on the same number of ranks.
 *  Collective. Throws as make_mesh. */
inline void write_mesh(pnpbs_mesh mesh, MPI_Comm comm, std::ostream& out) {
  Writer(mesh, comm).write(out);
}

/** Creates a mesh whose elements on each rank are those that the rank owns. Nothing is gathered,
 * read from a file or partitioned. All data are copied, so the mesh of PNPBS may be destroyed
 * afterwards. Attributes of elements are their tags: those of regions, on surfaces alone those of
 * the surfaces. Boundary elements are all facets, also inner ones, each on one rank, with their
 * tags as attributes. MFEM's attributes are positive: an entity with the tag 0 has an attribute one
 * more than the largest tag. Collective. Throws std::runtime_error on all ranks for a mesh without
 * ghost layers on several ranks, negative tags, more nodes than HYPRE_BigInt can number, and closed
 * surfaces alone, because MFEM aborts for a parallel mesh without boundary elements. An error of
 * PNPBS, such as a dead handle, throws only on the ranks where it occurs.
 *  @param[in] mesh  a mesh with one ghost layer or more, as created by
 *                   pnpbs_mesh_create(placement, 1, &mesh)
 *  @param[in] comm  the communicator of the mesh's context */
inline DistributedMesh make_mesh(pnpbs_mesh mesh, MPI_Comm comm) {
  int64_t all_nodes = 0;
  check(pnpbs_mesh_numbering(mesh, nullptr, &all_nodes, nullptr, nullptr));
  if (all_nodes > static_cast<int64_t>(std::numeric_limits<HYPRE_BigInt>::max()))
    throw std::runtime_error("the mesh needs a hypre with 64-bit integers");
  const Writer writer(mesh, comm);
  if (writer.attributes().facets == 0)
    throw std::runtime_error("MFEM takes no parallel mesh without boundary elements");
  std::stringstream text;
  writer.write(text);
  DistributedMesh made;
  made.mesh = std::make_unique<mfem::ParMesh>(comm, text);
  made.nodes = writer.nodes();
  made.untagged_attribute = writer.attributes().untagged_element;
  made.untagged_boundary_attribute = writer.attributes().untagged_facet;
  return made;
}

}  // namespace pnpbs_mfem

#endif
