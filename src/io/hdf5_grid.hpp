// SPDX-License-Identifier: BSD-3-Clause
// Grids in HDF5 files: one rank creates the file with its arrays, then all ranks write their rows.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "io/grid_arrays.hpp"
#include "io/hdf5.hpp"
#include "io/output_file.hpp"

namespace pnpbs::io {

// Creates the unpublished file of `output`: calls begin(file), then allocates the arrays. Returns
// their offsets, 0 for arrays without rows. `name` is the name of the file in messages. Throws
// Error(ErrorKind::file), or Error(ErrorKind::unsupported) without HDF5. Local.
std::vector<std::int64_t> lay_out(const OutputFile& output, const std::string& name,
                                  const std::vector<hdf5::Array>& arrays,
                                  const std::function<void(hdf5::NewFile&)>& begin);

// Adds the groups and attributes of a VTK unstructured grid in a single part.
void begin_vtk_grid(hdf5::NewFile& file, std::int64_t points, std::int64_t cells,
                    std::int64_t corners);

// An array with its path in the file.
struct PlacedArray {
  std::string path;  // path in the file
  GridArray array;
  bool is_table = false;  // two-dimensional even with one column

  int columns() const { return is_table || array.columns > 1 ? array.columns : 0; }
};

// Returns the arrays with paths in the group.
std::vector<PlacedArray> placed_in(const std::string& group, std::vector<GridArray> data);

// Writes the arrays. `begin` adds the groups and all other contents; it is called on rank 0.
// Collective.
void write_by_hdf5(const NodeSource& nodes, SharedFile& file,
                   const std::vector<PlacedArray>& arrays,
                   const std::function<void(hdf5::NewFile&)>& begin);

}  // namespace pnpbs::io
