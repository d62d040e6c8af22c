// SPDX-License-Identifier: BSD-3-Clause
// What a file of an unstructured grid holds of the nodes: its arrays, and how each is written.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "io/node_source.hpp"
#include "io/number_type.hpp"
#include "io/shared_file.hpp"

namespace pnpbs::io {

struct GridArray {
  std::string name;
  NumberType type;
  std::int64_t rows;  // of all ranks
  int columns;        // 1: a plain list
  // Appends the rows. Collective.
  std::function<void(const NodeSource&, SharedFile&)> write;

  std::uint64_t bytes() const { return static_cast<std::uint64_t>(rows * columns) * size_of(type); }
};

std::vector<GridArray> point_data(const Contents& all);
std::vector<GridArray> cell_data(const Contents& all);
// x, y and z, or so many of them.
GridArray point_array(const Contents& all, int coordinates = 3);

// What the nodes are called in a file that numbers them from 1, and zeros for each.
GridArray number_array(const Contents& all);
GridArray zero_array(const Contents& all, int columns);

// The numbers of the cells' corners, one cell behind the other.
GridArray corner_array(const Contents& all);
// Where in them each cell ends; or, with one more, where each begins and the last one ends.
GridArray cell_ends(const Contents& all);
GridArray cell_bounds(const Contents& all);
GridArray cell_types(const Contents& all);  // by VTK's numbers

}  // namespace pnpbs::io
