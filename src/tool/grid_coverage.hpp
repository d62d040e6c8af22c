// SPDX-License-Identifier: BSD-3-Clause
// At how many nodes a grid in a formula, or one that is d, has values of its own.
#pragma once

#include <cstdint>
#include <string>

#include "base/types.hpp"
#include "tool/library.hpp"
#include "tool/named_grid.hpp"
#include "tool/ranks.hpp"

namespace pnpbs::tool {

class GridCoverage {
 public:
  // Of the nodes there are, whose places are in degrees in messages if they are on a sphere. Counts
  // on the first rank alone. Collective. Throws Failure.
  GridCoverage(const NamedGrid& grid, pnpbs_placement placement, int dimension, bool on_sphere,
               pnpbs_context context, const Ranks& ranks);

  bool is_nowhere() const { return nodes_ > 0 && beyond_.count + without_data_.count == nodes_; }
  std::string words_for_nowhere() const;
  // How many lie beyond the grid's edge, and how many where it has no data; "" if none do.
  std::string words_for_beyond() const;
  std::string words_for_without_data() const;

 private:
  struct Nodes {
    std::int64_t count;
    Point<3> first;  // the least of their places
  };
  void count(Nodes& nodes, const Point<3>& place) const;
  void add_up(const Ranks& ranks);
  std::string grid_in_words() const;
  std::string text_of(const Nodes& nodes, const std::string& what) const;

  std::string name_, path_;
  int dimension_;
  bool on_sphere_;
  std::int64_t nodes_ = 0;
  Nodes beyond_, without_data_;
};

}  // namespace pnpbs::tool
