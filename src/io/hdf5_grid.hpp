// SPDX-License-Identifier: BSD-3-Clause
// Arrays of a grid in a file by HDF5.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "io/grid_arrays.hpp"
#include "io/hdf5.hpp"

namespace pnpbs::io {

struct PlacedArray {
  std::string path;  // in the file
  GridArray array;
  bool is_table = false;  // in two dimensions, even with one column

  int columns() const { return is_table || array.columns > 1 ? array.columns : 0; }
};

// Those of the nodes or cells in their group.
std::vector<PlacedArray> placed_in(const std::string& group, std::vector<GridArray> data);

// begin: adds what else is in the file, the groups among it; called on rank 0. Collective.
void write_by_hdf5(const NodeSource& nodes, SharedFile& file,
                   const std::vector<PlacedArray>& arrays,
                   const std::function<void(hdf5::NewFile&)>& begin);

}  // namespace pnpbs::io
