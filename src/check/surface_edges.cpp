// SPDX-License-Identifier: BSD-3-Clause
#include "check/surface_edges.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>
#include <vector>

#include "base/mixed_hash.hpp"
#include "comm/records.hpp"

namespace pnpbs {

namespace {

bool is_feature_node(const Nodes<3>& nodes, std::int64_t i) {
  return nodes.boundary_node(i) >= 0 && nodes.carrier(i) != Carrier::surface;
}

// Returns the edges of this rank's triangles, once for each triangle.
std::vector<SurfaceEdge> edges_here(const Results<3>& results) {
  const Nodes<3>& nodes = results.level().nodes;
  std::vector<SurfaceEdge> edges;
  results.for_open_facets([&](const std::array<std::int64_t, 3>& places) {
    for (std::size_t k = 0; k < 3; ++k) {
      std::int64_t i = results.node_at(places[k]), j = results.node_at(places[(k + 1) % 3]);
      const bool forward = nodes.id(i) < nodes.id(j);
      if (!forward) std::swap(i, j);
      edges.push_back(
          {nodes.id(i), nodes.id(j), 1, forward, sheets_at(results, i, j), nodes.position(i)});
    }
  });
  return edges;
}

// Sends all records of an edge to the same rank. Collective.
std::vector<SurfaceEdge> gathered(const Communicator& comm, const std::vector<SurfaceEdge>& edges) {
  if (comm.size() == 1) return edges;
  return redistribute(comm, edges, [&](const SurfaceEdge& edge) {
    const std::uint64_t key =
        mixed(static_cast<std::uint64_t>(edge.low)) ^ static_cast<std::uint64_t>(edge.high);
    return static_cast<int>(mixed(key) % static_cast<std::uint64_t>(comm.size()));
  });
}

bool is_matched(const SurfaceEdge& edge) {
  if (edge.sheets == 0) return edge.triangles == 2 && edge.left == 1;
  return edge.triangles == edge.sheets;
}

}  // namespace

std::int64_t sheets_at(const Results<3>& results, std::int64_t i, std::int64_t j) {
  const Level<3>& level = results.level();
  const Nodes<3>& nodes = level.nodes;
  if (!is_feature_node(nodes, i) || !is_feature_node(nodes, j)) return 0;
  const FeatureNodes& features = level.geometry.features();
  const std::int32_t a = nodes.boundary_node(i), b = nodes.boundary_node(j);
  if (!features.joined(a, b)) return 0;
  const auto curve_of = [&](std::int32_t n) {
    return features.nodes[static_cast<std::size_t>(n)].curve;
  };
  std::int32_t curve = std::max(curve_of(a), curve_of(b));
  for (std::size_t c = 0; curve < 0; ++c) {
    const std::vector<std::int32_t>& row = features.along[c];
    if (row.size() == 2 && std::minmax(row[0], row[1]) == std::minmax(a, b))
      curve = static_cast<std::int32_t>(c);
  }
  const Surface& surface = level.geometry.surface();
  const FeatureCurve& along = surface.features().curves[static_cast<std::size_t>(curve)];
  return std::ranges::count_if(along.facets.front(),
                               [&](std::int32_t f) { return surface.patch(f) >= 0; });
}

void for_unmatched_edges(const Results<3>& results,
                         const std::function<void(const SurfaceEdge&)>& visit) {
  std::vector<SurfaceEdge> edges = gathered(results.communicator(), edges_here(results));
  const auto ends = [](const SurfaceEdge& edge) { return std::tuple(edge.low, edge.high); };
  std::ranges::sort(edges, {}, ends);
  for (std::size_t first = 0, next = 0; first < edges.size(); first = next) {
    SurfaceEdge edge = edges[first];
    for (next = first + 1; next < edges.size() && ends(edges[next]) == ends(edge); ++next) {
      edge.triangles += edges[next].triangles;
      edge.left += edges[next].left;
    }
    if (!is_matched(edge)) visit(edge);
  }
}

}  // namespace pnpbs
