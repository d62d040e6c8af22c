// SPDX-License-Identifier: BSD-3-Clause
// VTKHDF writer (https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format), version 1.0,
// which every reader supports. It has the arrays of a .vtu file. Each is contiguous, so that all
// ranks write their rows concurrently.
#include <utility>

#include "io/formats.hpp"
#include "io/grid_arrays.hpp"
#include "io/hdf5_grid.hpp"

namespace pnpbs::io {

namespace {

std::vector<PlacedArray> vtk_arrays(const Contents& all) {
  const std::string vtk = "/VTKHDF/";
  std::vector<PlacedArray> arrays = placed_in(vtk + "PointData", point_data(all));
  for (PlacedArray& array : placed_in(vtk + "CellData", cell_data(all)))
    arrays.push_back(std::move(array));
  arrays.push_back({vtk + "Points", point_array(all)});
  arrays.push_back({vtk + "Connectivity", corner_array(all)});
  arrays.push_back({vtk + "Offsets", cell_bounds(all)});
  arrays.push_back({vtk + "Types", cell_types(all)});
  return arrays;
}

}  // namespace

void write_vtkhdf(const NodeSource& nodes, SharedFile& file) {
  const Contents& all = nodes.contents();
  write_by_hdf5(nodes, file, vtk_arrays(all), [&](hdf5::NewFile& made) {
    begin_vtk_grid(made, all.nodes, all.cell_count(), corner_array(all).rows);
    if (!all.is_beside) made.set("/VTKHDF/PointData", "Scalars", std::string("spacing"));
    if (all.cells != Cells::nodes) made.add_group("/VTKHDF/CellData");
  });
}

}  // namespace pnpbs::io
