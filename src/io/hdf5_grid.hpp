// SPDX-License-Identifier: BSD-3-Clause
// Arrays of a grid in a file by HDF5, and how one rank makes such a file whose rows all ranks write
// afterwards.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "io/grid_arrays.hpp"
#include "io/hdf5.hpp"
#include "io/output_file.hpp"

namespace pnpbs::io {

// In place of the file aside of `output`: what `begin` adds, and room for the arrays. Returns where
// these begin, without rows 0. name: for messages. Throws Error(ErrorKind::file), and
// Error(ErrorKind::unsupported) without HDF5. Local.
std::vector<std::int64_t> lay_out(const OutputFile& output, const std::string& name,
                                  const std::vector<hdf5::Array>& arrays,
                                  const std::function<void(hdf5::NewFile&)>& begin);

// What a file by HDF5 needs to be one that VTK reads, of an unstructured grid in one part.
void begin_vtk_grid(hdf5::NewFile& file, std::int64_t points, std::int64_t cells,
                    std::int64_t corners);

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
