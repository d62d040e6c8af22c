// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/distributed_mesh.hpp"

#include <algorithm>

#include "base/rank_limit.hpp"
#include "mesh/ghost_layers.hpp"
#include "mesh/mesh_arrays.hpp"
#include "mesh/mesh_facets.hpp"
#include "mesh/node_sharing.hpp"
#include "mesh/owned_elements.hpp"

namespace pnpbs {

namespace {

// The facets of the rank's elements, and those of its ghost elements, which their owners have.
template <std::size_t Corners>
void add_facets_of_ghosts(const Communicator& comm, const RankRanges& elements,
                          const std::vector<MeshElement<Corners>>& ghosts,
                          std::vector<MeshFacet<Corners>>& facets) {
  using Facet = MeshFacet<Corners>;
  const auto key = [](const Facet& facet) {
    return std::array{facet.elements[0], std::int64_t{facet.opposite[0]}};
  };
  struct Side {
    std::int64_t element;
    std::size_t facet;
  };
  std::vector<Side> sides;
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (const std::int64_t element : facets[f].elements)
      if (elements.has(element)) sides.push_back({element, f});
  std::ranges::sort(sides, {}, &Side::element);
  const auto give = [&](std::int64_t element, int, std::vector<Facet>& answers) {
    for (auto side = std::ranges::lower_bound(sides, element, {}, &Side::element);
         side != sides.end() && side->element == element; ++side)
      answers.push_back(facets[side->facet]);
  };
  std::vector<std::int64_t> numbers;
  for (const MeshElement<Corners>& ghost : ghosts) numbers.push_back(ghost.number);
  for (const Facet& facet : ask_owners<Facet>(comm, elements, numbers, give, key))
    facets.push_back(facet);
  sort_and_keep_one(facets, key);
}

template <int Dim>
MeshNode mesh_node(const Results<Dim>& results, const RankRanges& nodes, std::int64_t number) {
  const Nodes<Dim>& from = results.level().nodes;
  const std::int64_t i = results.node_at(number - nodes.first());
  return {number, from.id(i), results.place_in_space(i), from.tag(i)};
}

template <std::size_t Corners, int Dim>
void make(Results<Dim>& results, int layers, DistributedMesh& mesh) {
  const Communicator& comm = results.communicator();
  results.prepare_stars();
  const RankRanges nodes(comm, results.count());
  const std::vector<std::int64_t> numbers = node_numbers(results, nodes);

  std::vector<MeshElement<Corners>> own = owned_elements<Corners>(results, numbers);
  const RankRanges elements(comm, static_cast<std::int64_t>(own.size()));
  std::int64_t next = elements.first();
  for (MeshElement<Corners>& element : own) element.number = next++;

  const ElementsAtNodes<Corners> at_nodes(comm, nodes, std::move(own));
  auto facets = facets_of_owned_elements(results, numbers, nodes, elements, at_nodes);
  const std::vector<std::int64_t>& shared = at_nodes.nodes_of_others();
  const auto ghosts = ghost_elements(comm, nodes, elements, at_nodes, shared, layers);
  add_facets_of_ghosts(comm, elements, ghosts, facets);

  std::vector<std::int64_t> others = nodes_of_others<Corners>(nodes, ghosts);
  others.insert(others.end(), shared.begin(), shared.end());
  sort_and_keep_one(others);
  const auto give = [&](std::int64_t number, int, std::vector<MeshNode>& answers) {
    answers.push_back(mesh_node(results, nodes, number));
  };
  const auto node_ghosts = ask_owners<MeshNode>(comm, nodes, others, give,
                                                [](const MeshNode& node) { return node.number; });

  require_fits_rank(nodes.count() + static_cast<std::int64_t>(others.size()), "nodes");
  require_fits_rank(elements.count() + static_cast<std::int64_t>(ghosts.size()), "elements");
  MeshArrays<Corners> arrays(mesh, nodes, elements);
  arrays.resize(static_cast<std::size_t>(nodes.count()) + node_ghosts.size(),
                at_nodes.own().size() + ghosts.size());
  for (std::int64_t n = nodes.first(); n < nodes.end(); ++n)
    arrays.add(mesh_node(results, nodes, n));
  for (const MeshNode& node : node_ghosts) arrays.add(node);
  for (const auto& element : at_nodes.own()) arrays.add(element);
  for (const auto& element : ghosts) arrays.add(element);
  for (const auto& facet : facets) arrays.add(facet);
  for (const NodeShare& share : node_sharing(comm, nodes, shared)) arrays.add(share);
}

}  // namespace

std::unique_ptr<DistributedMesh> make_distributed_mesh(NodalResults& results, int layers) {
  auto mesh = std::make_unique<DistributedMesh>();
  mesh->dimension = results.coordinates();
  mesh->kind = results.kind();
  in_its_dimension(results, [&]<int Dim>(Results<Dim>& in) {
    mesh->names = in.domain().names();
    if (in.kind() == GeometryKind::surface)
      make<3>(in, layers, *mesh);
    else
      make<Dim + 1>(in, layers, *mesh);
  });
  return mesh;
}

}  // namespace pnpbs
