// SPDX-License-Identifier: BSD-3-Clause
// C interface: distributed meshes.
#include <limits>
#include <string>

#include "api/copy_out.hpp"
#include "api/placement_calls.hpp"
#include "io/msh_parts.hpp"
#include "mesh/distributed_mesh.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

namespace {

constexpr std::int32_t kMaxGhostLayers = 16;

void require_layers(const Communicator& comm, std::int32_t layers) {
  if (!comm.same_on_all(static_cast<std::uint64_t>(layers)))
    throw Error(ErrorKind::argument, "argument ghost_layers = " + std::to_string(layers) +
                                         " here; all ranks must give the same");
  if (layers < 0 || layers > kMaxGhostLayers)
    throw Error(ErrorKind::argument, "argument ghost_layers = " + std::to_string(layers) +
                                         "; there can be 0 .. " + std::to_string(kMaxGhostLayers));
}

std::int64_t size_of(const auto& array) { return static_cast<std::int64_t>(array.size()); }

// Runs body(mesh) as a local call.
template <class Body>
pnpbs_status of_mesh(pnpbs_mesh mesh, const Body& body) {
  return guarded(mesh, [&](MeshObject& object) {
    body(*object.mesh);
    return PNPBS_OK;
  });
}

template <class Number>
pnpbs_status copy_connectivity(pnpbs_mesh mesh, std::int64_t capacity, Number* numbers) {
  return of_mesh(mesh, [&](const DistributedMesh& m) {
    require_capacity(capacity, size_of(m.element_numbers));
    if (m.all_nodes > std::int64_t{std::numeric_limits<Number>::max()})
      throw Error(ErrorKind::capacity,
                  "the mesh has " + std::to_string(m.all_nodes) +
                      " nodes over all ranks, which 32 bits cannot number: use 64");
    if (m.element_corners.empty()) return;
    require_pointer(numbers, "numbers");
    for (const std::int32_t node : m.element_corners)
      *numbers++ = static_cast<Number>(m.numbers[static_cast<std::size_t>(node)]);
  });
}

void require_prefix(const Communicator& comm, const char* prefix) {
  collective_try(comm, [&] {
    require_pointer(prefix, "prefix");
    if (*prefix == 0)
      throw Error(ErrorKind::argument,
                  "argument prefix is empty; the files are named prefix_1.msh, prefix_2.msh, ...");
  });
  const std::string mine = prefix;
  Bytes first(mine.begin(), mine.end());
  comm.broadcast(first, 0);
  if (std::string(first.begin(), first.end()) != mine)
    throw Error(ErrorKind::argument, "argument prefix = '" + mine + "'; on rank 0 it is '" +
                                         std::string(first.begin(), first.end()) +
                                         "': all ranks must give the same");
}

}  // namespace

pnpbs_status pnpbs_mesh_create(pnpbs_placement placement, int32_t ghost_layers, pnpbs_mesh* mesh) {
  return collective_create(placement, mesh, "mesh", meshes, [&](PlacementObject& object) {
    NodalResults& results = object.placement->results();
    require_not_periodic(results, "there is no mesh");
    require_layers(results.communicator(), ghost_layers);
    auto made = std::make_shared<MeshObject>();
    made->context = object.context;
    made->mesh = make_distributed_mesh(results, ghost_layers);
    return made;
  });
}

pnpbs_status pnpbs_mesh_destroy(pnpbs_mesh* mesh) { return destroy(mesh, meshes); }

pnpbs_status pnpbs_mesh_sizes(pnpbs_mesh mesh, int32_t* dim, int32_t* corners, int64_t* owned_nodes,
                              int64_t* nodes, int64_t* owned_elements, int64_t* elements,
                              int64_t* facets) {
  return of_mesh(mesh, [&](const DistributedMesh& m) {
    if (dim) *dim = m.dimension;
    if (corners) *corners = m.corners;
    if (owned_nodes) *owned_nodes = m.owned_nodes;
    if (nodes) *nodes = size_of(m.numbers);
    if (owned_elements) *owned_elements = m.owned_elements;
    if (elements) *elements = size_of(m.element_numbers);
    if (facets) *facets = size_of(m.facet_tags);
  });
}

pnpbs_status pnpbs_mesh_numbering(pnpbs_mesh mesh, int64_t* first_node, int64_t* all_nodes,
                                  int64_t* first_element, int64_t* all_elements) {
  return of_mesh(mesh, [&](const DistributedMesh& m) {
    if (first_node) *first_node = m.first_node;
    if (all_nodes) *all_nodes = m.all_nodes;
    if (first_element) *first_element = m.first_element;
    if (all_elements) *all_elements = m.all_elements;
  });
}

pnpbs_status pnpbs_mesh_get_nodes(pnpbs_mesh mesh, int64_t capacity, double* coordinates,
                                  int64_t* numbers, int64_t* ids, int32_t* owners, int32_t* tags) {
  return of_mesh(mesh, [&](const DistributedMesh& m) {
    require_capacity(capacity, size_of(m.numbers));
    copy_out(m.x, coordinates);
    copy_out(m.numbers, numbers);
    copy_out(m.ids, ids);
    copy_out(m.owners, owners);
    copy_out(m.tags, tags);
  });
}

pnpbs_status pnpbs_mesh_get_elements(pnpbs_mesh mesh, int64_t capacity, int32_t* nodes,
                                     int64_t* numbers, int32_t* owners, int32_t* tags) {
  return of_mesh(mesh, [&](const DistributedMesh& m) {
    require_capacity(capacity, size_of(m.element_numbers));
    copy_out(m.element_corners, nodes);
    copy_out(m.element_numbers, numbers);
    copy_out(m.element_owners, owners);
    copy_out(m.element_tags, tags);
  });
}

pnpbs_status pnpbs_mesh_get_connectivity(pnpbs_mesh mesh, int64_t capacity, int64_t* numbers) {
  return copy_connectivity(mesh, capacity, numbers);
}

pnpbs_status pnpbs_mesh_get_connectivity_int32(pnpbs_mesh mesh, int64_t capacity,
                                               int32_t* numbers) {
  return copy_connectivity(mesh, capacity, numbers);
}

pnpbs_status pnpbs_mesh_get_facets(pnpbs_mesh mesh, int64_t capacity, int32_t* nodes, int32_t* tags,
                                   int32_t* elements, int32_t* opposite, int8_t* inner,
                                   int32_t* owners) {
  return of_mesh(mesh, [&](const DistributedMesh& m) {
    require_capacity(capacity, size_of(m.facet_tags));
    copy_out(m.facet_corners, nodes);
    copy_out(m.facet_tags, tags);
    copy_out(m.facet_elements, elements);
    copy_out(m.facet_opposite, opposite);
    copy_out(m.facet_inner, inner);
    copy_out(m.facet_owners, owners);
  });
}

pnpbs_status pnpbs_mesh_sharing_sizes(pnpbs_mesh mesh, int64_t* nodes, int64_t* entries) {
  return of_mesh(mesh, [&](const DistributedMesh& m) {
    if (nodes) *nodes = size_of(m.shared_nodes);
    if (entries) *entries = size_of(m.sharing_ranks);
  });
}

pnpbs_status pnpbs_mesh_get_sharing(pnpbs_mesh mesh, int64_t nodes, int64_t entries,
                                    int32_t* shared, int64_t* offsets, int32_t* ranks) {
  return of_mesh(mesh, [&](const DistributedMesh& m) {
    require_capacity(nodes, size_of(m.shared_nodes), "nodes");
    require_capacity(entries, size_of(m.sharing_ranks), "entries");
    copy_out(m.shared_nodes, shared);
    copy_out(m.sharing_offsets, offsets);
    copy_out(m.sharing_ranks, ranks);
  });
}

pnpbs_status pnpbs_mesh_write(pnpbs_mesh mesh, const char* prefix) {
  return guarded(mesh, [&](MeshObject& object) {
    const Computing computing(*object.context);
    const Communicator& comm = *object.context->communicator;
    collective_try(comm, [&] {
      require_prefix(comm, prefix);
      io::write_msh_parts(comm, *object.mesh, prefix);
    });
    return PNPBS_OK;
  });
}
