// SPDX-License-Identifier: BSD-3-Clause
#include "results/region_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <map>
#include <utility>

#include "base/exact_sum.hpp"
#include "base/index.hpp"
#include "base/space_vectors.hpp"
#include "comm/records.hpp"
#include "results/element_regions.hpp"
#include "sphere/sphere_geometry.hpp"

namespace pnpbs {

namespace {

// The share of this rank in a region.
struct Share {
  std::int64_t nodes = 0, elements = 0;
  ExactSum measure;
};

// Returns the area or volume of an element, given by the result indices of its corners. The corners
// are taken in the order of their ids, so the rounding does not depend on ranks.
template <int Dim>
double measure_of(const Results<Dim>& results, std::array<std::int64_t, Dim + 1> places) {
  std::ranges::sort(places, {},
                    [&](std::int64_t p) { return results.level().nodes.id(results.node_at(p)); });
  std::array<Point<3>, Dim + 1> x;
  for (std::size_t k = 0; k < x.size(); ++k)
    x[k] = results.point_in_space(results.node_at(places[k]));
  if constexpr (Dim == 3) {
    return std::fabs(
               dot(difference(x[1], x[0]), cross(difference(x[2], x[0]), difference(x[3], x[0])))) /
           6;
  } else {
    if (const double radius = results.embedding().radius(); radius > 0)
      return std::fabs(signed_area(unit_vector(x[0]), unit_vector(x[1]), unit_vector(x[2]))) *
             radius * radius;
    return 0.5 * length(cross(difference(x[1], x[0]), difference(x[2], x[0])));
  }
}

// A node of an element with this tag.
struct NodeTag {
  std::int64_t id;
  std::int32_t tag;

  auto operator<=>(const NodeTag&) const = default;
};

// Adds the elements of this rank to the shares. Returns each of their nodes once per tag.
template <int Dim>
std::vector<NodeTag> add_elements(const Results<Dim>& results,
                                  std::map<std::int32_t, Share>& shares) {
  constexpr std::int64_t kNone = std::int64_t{1} << 40;  // no tag has this value
  std::vector<std::int64_t> first(static_cast<std::size_t>(results.held()), kNone);
  std::vector<NodeTag> nodes;  // with tags other than the first ones, perhaps several times
  const auto id = [&](std::int64_t place) {
    return results.level().nodes.id(results.node_at(place));
  };
  ElementRegions<Dim> region_of(results);
  results.for_elements([&](const std::array<std::int64_t, Dim + 1>& places) {
    const std::int32_t tag = region_of(places);
    Share& share = shares[tag];
    ++share.elements;
    share.measure.add(measure_of<Dim>(results, places));
    for (const std::int64_t place : places) {
      if (first[index(place)] == kNone) first[index(place)] = tag;
      if (first[index(place)] != tag) nodes.push_back({id(place), tag});
    }
  });
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  for (std::int64_t place = 0; place < results.held(); ++place)
    if (first[index(place)] != kNone)
      nodes.push_back({id(place), static_cast<std::int32_t>(first[index(place)])});
  return nodes;
}

// Adds the nodes to the shares of their owners. Collective.
template <int Dim>
void add_nodes(const Results<Dim>& results, std::vector<NodeTag> nodes,
               std::map<std::int32_t, Share>& shares) {
  const Communicator& comm = results.communicator();
  if (comm.size() > 1) {
    Outbox outbox;
    collective_try(comm, [&] {
      std::map<std::int64_t, int> owners;  // of ghosts
      for (std::int64_t place = results.count(); place < results.held(); ++place) {
        const std::int64_t i = results.node_at(place);
        owners.emplace(results.level().nodes.id(i), results.owner_of(i));
      }
      for (const NodeTag& node : nodes) {
        const auto ghost = owners.find(node.id);
        pack(outbox.to(ghost == owners.end() ? comm.rank() : ghost->second), node);
      }
    });
    nodes = deliver<NodeTag>(comm, outbox);
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
  collective_try(comm, [&] {
    for (const NodeTag& node : nodes) ++shares[node.tag].nodes;
  });
}

}  // namespace

template <int Dim>
std::vector<RegionFigures> region_figures(Results<Dim>& results) {
  constexpr std::size_t kRow = 2 + ExactSum::kEntries;
  const Communicator& comm = results.communicator();
  results.prepare_stars();
  std::map<std::int32_t, Share> shares;
  std::vector<NodeTag> nodes;
  collective_try(comm, [&] { nodes = add_elements(results, shares); });
  add_nodes(results, std::move(nodes), shares);
  std::vector<std::int32_t> tags;
  collective_try(comm, [&] {
    for (const auto& [tag, share] : shares) tags.push_back(tag);
  });
  tags = of_all_ranks(comm, tags);
  std::ranges::sort(tags);
  tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
  std::vector<std::int64_t> rows;
  collective_try(comm, [&] {
    rows.resize(kRow * tags.size());
    auto next = rows.begin();
    for (const std::int32_t tag : tags) {
      Share& share = shares[tag];
      share.measure.carry();
      *next++ = share.nodes;
      *next++ = share.elements;
      next = std::ranges::copy(share.measure.entries(), next).out;
    }
  });
  comm.allreduce_sum(rows);
  std::vector<RegionFigures> figures;
  for (std::size_t k = 0; k < tags.size(); ++k) {
    const auto row = rows.begin() + static_cast<std::ptrdiff_t>(kRow * k);
    ExactSum measure;
    std::copy_n(row + 2, ExactSum::kEntries, measure.entries().begin());
    figures.push_back({tags[k], row[0], row[1], measure.value()});
  }
  return figures;
}

template std::vector<RegionFigures> region_figures(Results<2>&);
template std::vector<RegionFigures> region_figures(Results<3>&);

}  // namespace pnpbs
