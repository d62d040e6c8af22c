// SPDX-License-Identifier: BSD-3-Clause
// Arrays of an unstructured grid in a file, with the function that writes each.
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

// An array of the file.
struct GridArray {
  std::string name;
  NumberType type;
  std::int64_t rows;  // over all ranks
  int columns;        // 1: a one-dimensional list
  // Appends all rows to the file. Collective.
  std::function<void(const NodeSource&, SharedFile&)> write;

  std::uint64_t bytes() const { return static_cast<std::uint64_t>(rows * columns) * size_of(type); }
};

std::vector<GridArray> point_data(const Contents& all);
std::vector<GridArray> cell_data(const Contents& all);
// Returns the positions with this number of coordinates.
GridArray point_array(const Contents& all, int coordinates = 3);

// Return the node numbers of a file that counts from 1, and an array of zeros.
GridArray number_array(const Contents& all);
GridArray zero_array(const Contents& all, int columns);

// Returns the node numbers of the corners of all cells.
GridArray corner_array(const Contents& all);
// Return the index in the corner array at which each cell ends, or begins; cell_bounds() has the
// end of the last cell, too.
GridArray cell_ends(const Contents& all);
GridArray cell_bounds(const Contents& all);
GridArray cell_types(const Contents& all);  // VTK's cell types

}  // namespace pnpbs::io
