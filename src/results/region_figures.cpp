// SPDX-License-Identifier: BSD-3-Clause
#include "results/region_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

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

template <int Dim>
std::map<std::int32_t, Share> own_shares(const Results<Dim>& results) {
  std::map<std::int32_t, Share> shares;
  ElementRegions<Dim> region_of(results);
  std::vector<std::int32_t> at_node;
  for (std::int64_t place = 0; place < results.count(); ++place) {
    at_node.clear();
    results.level().stars.for_simplices(results.node_at(place),
                                        [&](const typename Stars<Dim>::Corners& others) {
                                          std::array<std::int64_t, Dim + 1> places{place};
                                          for (std::size_t k = 0; k < Dim; ++k)
                                            places[k + 1] = results.place_of(others[k]);
                                          at_node.push_back(region_of(places));
                                        });
    std::ranges::sort(at_node);
    at_node.erase(std::unique(at_node.begin(), at_node.end()), at_node.end());
    for (const std::int32_t tag : at_node) ++shares[tag].nodes;
  }
  results.for_elements([&](const std::array<std::int64_t, Dim + 1>& places) {
    Share& share = shares[region_of(places)];
    ++share.elements;
    share.measure.add(measure_of<Dim>(results, places));
  });
  return shares;
}

}  // namespace

template <int Dim>
std::vector<RegionFigures> region_figures(Results<Dim>& results) {
  constexpr std::size_t kRow = 2 + ExactSum::kEntries;
  const Communicator& comm = results.communicator();
  results.prepare_stars();
  std::map<std::int32_t, Share> shares;
  std::vector<std::int32_t> tags;
  collective_try(comm, [&] {
    shares = own_shares(results);
    for (const auto& [tag, share] : shares) tags.push_back(tag);
  });
  tags = of_all_ranks(comm, tags);
  std::ranges::sort(tags);
  tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
  std::vector<std::int64_t> rows(kRow * tags.size());
  auto next = rows.begin();
  for (const std::int32_t tag : tags) {
    Share& share = shares[tag];
    share.measure.carry();
    *next++ = share.nodes;
    *next++ = share.elements;
    next = std::ranges::copy(share.measure.entries(), next).out;
  }
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
