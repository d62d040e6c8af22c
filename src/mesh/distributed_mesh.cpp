// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/distributed_mesh.hpp"

#include <algorithm>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include "base/rank_limit.hpp"
#include "mesh/elements_at_nodes.hpp"
#include "mesh/mesh_facets.hpp"
#include "mesh/mesh_records.hpp"
#include "mesh/node_sharing.hpp"
#include "mesh/owned_elements.hpp"

namespace pnpbs {
namespace {

// The arrays of a DistributedMesh while they are filled. It converts the global numbers of nodes
// and elements to the local indices that solvers use.
template <std::size_t Corners>
class MeshArrays {
 public:
  MeshArrays(DistributedMesh& mesh, const RankRanges& nodes, const RankRanges& elements)
      : mesh_(mesh), nodes_(nodes), elements_(elements) {
    mesh.corners = static_cast<int>(Corners);
    mesh.owned_nodes = nodes.count();
    mesh.first_node = nodes.first();
    mesh.all_nodes = nodes.total();
    mesh.owned_elements = elements.count();
    mesh.first_element = elements.first();
    mesh.all_elements = elements.total();
  }

  // Sets the array lengths to these counts, owned nodes and elements included. The add() functions
  // then fill the entries in order.
  void resize(std::size_t nodes, std::size_t elements) {
    mesh_.x.resize(nodes * static_cast<std::size_t>(mesh_.dimension));
    for (auto* array : {&mesh_.numbers, &mesh_.ids}) array->resize(nodes);
    for (auto* array : {&mesh_.owners, &mesh_.tags}) array->resize(nodes);
    mesh_.element_corners.resize(elements * Corners);
    mesh_.element_numbers.resize(elements);
    for (auto* array : {&mesh_.element_owners, &mesh_.element_tags}) array->resize(elements);
  }

  // Adds a node. Owned nodes come first, then the others by increasing number.
  void add(const MeshNode& node) {
    const std::size_t n = node_count_++, dim = static_cast<std::size_t>(mesh_.dimension);
    std::copy_n(node.x.begin(), dim, mesh_.x.begin() + static_cast<std::ptrdiff_t>(dim * n));
    mesh_.numbers[n] = node.number;
    mesh_.ids[n] = node.id;
    mesh_.owners[n] = nodes_.owner(node.number);
    mesh_.tags[n] = node.tag;
  }
  // Adds an element, in the same order. All nodes must have been added.
  void add(const MeshElement<Corners>& element) {
    const std::size_t e = element_count_++;
    for (std::size_t k = 0; k < Corners; ++k)
      mesh_.element_corners[Corners * e + k] = node_index(element.corners[k]);
    mesh_.element_numbers[e] = element.number;
    mesh_.element_owners[e] = elements_.owner(element.number);
    mesh_.element_tags[e] = element.tag;
  }
  // Adds a facet. All elements must have been added.
  void add(const MeshFacet<Corners>& facet) {
    const std::size_t here = element_index(facet.elements[0]) >= 0 ? 0 : 1;
    for (const std::int64_t corner : facet.corners)
      mesh_.facet_corners.push_back(node_index(corner));
    mesh_.facet_elements.push_back(element_index(facet.elements[here]));
    mesh_.facet_elements.push_back(here == 0 ? element_index(facet.elements[1]) : -1);
    mesh_.facet_opposite.push_back(facet.opposite[here]);
    mesh_.facet_tags.push_back(facet.tag);
    mesh_.facet_owners.push_back(elements_.owner(facet.elements[0]));
    mesh_.facet_inner.push_back(facet.elements[1] != kNoElement);
  }
  // Adds a rank that shares a node. Shares must come sorted by node and rank.
  void add(const NodeShare& share) {
    const std::int32_t node = node_index(share.node);
    if (mesh_.shared_nodes.empty() || mesh_.shared_nodes.back() != node) {
      mesh_.shared_nodes.push_back(node);
      mesh_.sharing_offsets.push_back(mesh_.sharing_offsets.back());
    }
    mesh_.sharing_ranks.push_back(share.rank);
    ++mesh_.sharing_offsets.back();
  }

 private:
  // Returns the local index of `number`, or -1 if this rank does not have it.
  static std::int32_t index(const RankRanges& ranges, const std::vector<std::int64_t>& numbers,
                            std::int64_t number) {
    if (ranges.has(number)) return static_cast<std::int32_t>(number - ranges.first());
    const auto others = numbers.begin() + ranges.count();
    const auto found = std::lower_bound(others, numbers.end(), number);
    if (found == numbers.end() || *found != number) return -1;
    return static_cast<std::int32_t>(found - numbers.begin());
  }
  std::int32_t node_index(std::int64_t number) const {
    return index(nodes_, mesh_.numbers, number);
  }
  std::int32_t element_index(std::int64_t number) const {
    return index(elements_, mesh_.element_numbers, number);
  }

  DistributedMesh& mesh_;
  const RankRanges& nodes_;
  const RankRanges& elements_;
  std::size_t node_count_ = 0, element_count_ = 0;  // added up to now
};

// Returns the sorted numbers of those corners of `elements` that other ranks own.
template <std::size_t Corners, class Elements>
std::vector<std::int64_t> nodes_of_others(const RankRanges& nodes, const Elements& elements) {
  std::vector<std::int64_t> numbers;
  for (const MeshElement<Corners>& element : elements)
    for (const std::int64_t corner : element.corners)
      if (!nodes.has(corner)) numbers.push_back(corner);
  sort_and_keep_one(numbers);
  return numbers;
}

// Returns `layers` layers of elements of other ranks around the elements of this rank, sorted by
// number. `front` holds the nodes of owned elements that other ranks own; the next layer comes from
// their owners. Elements at owned nodes are known already, from `at_nodes`. Collective.
template <std::size_t Corners>
std::vector<MeshElement<Corners>> ghost_elements(const Communicator& comm, const RankRanges& nodes,
                                                 const RankRanges& elements,
                                                 const ElementsAtNodes<Corners>& at_nodes,
                                                 std::vector<std::int64_t> front, int layers) {
  using Element = MeshElement<Corners>;
  const auto number = [](const Element& element) { return element.number; };
  const auto give = [&](std::int64_t node, int rank, std::vector<Element>& answers) {
    at_nodes.at(node, [&](const Element& element) {
      if (elements.owner(element.number) != rank) answers.push_back(element);
    });
  };
  if (layers == 0) return {};
  std::vector<Element> ghosts(at_nodes.of_others().begin(), at_nodes.of_others().end());
  std::unordered_set<std::int64_t> asked;
  for (int layer = 1;; ++layer) {
    for (const Element& element : query_owners<Element>(comm, nodes, front, give, number))
      ghosts.push_back(element);
    sort_and_keep_one(ghosts, number);
    if (layer == layers) return ghosts;
    asked.insert(front.begin(), front.end());
    front = nodes_of_others<Corners>(nodes, ghosts);
    std::erase_if(front, [&](std::int64_t node) { return asked.contains(node); });
  }
}

// Adds the facets of ghost elements to `facets`, which holds the facets of owned elements. The
// owners of the ghost elements send them. Collective.
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
  for (const Facet& facet : query_owners<Facet>(comm, elements, numbers, give, key))
    facets.push_back(facet);
  sort_and_keep_one(facets, key);
}

template <int Dim>
MeshNode mesh_node(const Results<Dim>& results, const RankRanges& nodes, std::int64_t number) {
  const Nodes<Dim>& from = results.level().nodes;
  const std::int64_t i = results.node_at(number - nodes.first());
  return {number, from.id(i), results.point_in_space(i), from.tag(i)};
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
  const auto node_ghosts = query_owners<MeshNode>(comm, nodes, others, give,
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
  visit_dimension(results, [&]<int Dim>(Results<Dim>& in) {
    mesh->names = in.domain().names();
    if (in.kind() == GeometryKind::surface)
      make<3>(in, layers, *mesh);
    else
      make<Dim + 1>(in, layers, *mesh);
  });
  return mesh;
}

}  // namespace pnpbs
