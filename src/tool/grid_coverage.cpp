// SPDX-License-Identifier: BSD-3-Clause
#include "tool/grid_coverage.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "tool/density.hpp"
#include "tool/place_text.hpp"

namespace pnpbs::tool {
namespace {

constexpr double none_yet = std::numeric_limits<double>::infinity();

}  // namespace

GridCoverage::GridCoverage(const NamedGrid& grid, pnpbs_placement placement, int dimension,
                           bool on_sphere, pnpbs_context context, const Ranks& ranks)
    : name_(grid.name()),
      path_(grid.path()),
      dimension_(dimension),
      on_sphere_(on_sphere),
      beyond_{0, {none_yet, none_yet, none_yet}},
      without_data_(beyond_) {
  ranks.agreed([&] {
    const std::vector<double> x = coordinates_of(placement, dimension, context);
    nodes_ = std::ssize(x) / dimension;
    std::vector<double> values(static_cast<std::size_t>(nodes_));
    std::vector<std::int32_t> inside(values.size());
    grid.evaluate(nodes_, x.data(), values.data(), inside.data());
    for (std::int64_t i = 0; i < nodes_; ++i) {
      const std::int32_t kind = inside[static_cast<std::size_t>(i)];
      Point<3> place{};
      std::copy_n(x.data() + dimension * i, dimension, place.begin());
      if (kind == NamedGrid::beyond_edge) count(beyond_, place);
      if (kind == NamedGrid::without_data) count(without_data_, place);
    }
  });
  add_up(ranks);
}

void GridCoverage::count(Nodes& nodes, const Point<3>& place) const {
  ++nodes.count;
  nodes.first = std::min(nodes.first, place);
}

void GridCoverage::add_up(const Ranks& ranks) {
  struct Counts {
    std::int64_t nodes;
    Nodes beyond, without_data;
  };
  const Counts own{nodes_, beyond_, without_data_};
  nodes_ = beyond_.count = without_data_.count = 0;
  for (const Counts& its : ranks.gather(std::vector<Counts>{own})) {
    nodes_ += its.nodes;
    for (const auto& [all, some] :
         {std::pair{&beyond_, &its.beyond}, std::pair{&without_data_, &its.without_data}}) {
      all->count += some->count;
      all->first = std::min(all->first, some->first);
    }
  }
}

std::string GridCoverage::grid_in_words() const {
  return "the grid '" + name_ + "' (" + path_ + ")";
}

std::string GridCoverage::text_of(const Nodes& nodes, const std::string& what) const {
  return "of " + std::to_string(nodes_) + " nodes, " + std::to_string(nodes.count) + " lie " +
         what + ", one of them at " + place_text(nodes.first.data(), dimension_, on_sphere_);
}

std::string GridCoverage::words_for_nowhere() const {
  std::string words = grid_in_words() + " has no value anywhere in the domain: ";
  if (beyond_.count > 0) words += text_of(beyond_, "beyond its edge");
  if (beyond_.count > 0 && without_data_.count > 0) words += "; ";
  if (without_data_.count > 0) words += text_of(without_data_, "where it has no data");
  return words;
}

std::string GridCoverage::words_for_beyond() const {
  if (beyond_.count == 0) return "";
  return grid_in_words() +
         " covers only a part of the domain: " + text_of(beyond_, "beyond its edge") +
         "; there its values are those at the edge";
}

std::string GridCoverage::words_for_without_data() const {
  if (without_data_.count == 0) return "";
  return grid_in_words() +
         " has gaps in the domain: " + text_of(without_data_, "where it has no data") +
         "; there its values are those of the nearest cells that have some";
}

}  // namespace pnpbs::tool
