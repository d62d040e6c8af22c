// SPDX-License-Identifier: BSD-3-Clause
#include "io/hdf5_grid.hpp"

#include <utility>

#include "io/hdf5_layout.hpp"

namespace pnpbs::io {

std::vector<PlacedArray> placed_in(const std::string& group, std::vector<GridArray> data) {
  std::vector<PlacedArray> arrays;
  for (GridArray& array : data) {
    const std::string path = group + "/" + array.name;
    arrays.push_back({path, std::move(array)});
  }
  return arrays;
}

void write_by_hdf5(const NodeSource& nodes, SharedFile& file,
                   const std::vector<PlacedArray>& arrays,
                   const std::function<void(hdf5::NewFile&)>& begin) {
  const std::vector<std::int64_t> places = file.make([&](const OutputFile& output) {
    std::vector<hdf5::Array> all;
    for (const PlacedArray& placed : arrays)
      all.push_back({placed.path, placed.array.type, placed.array.rows, placed.columns()});
    return lay_out(output, output.quoted(), all, begin);
  });
  for (std::size_t k = 0; k < arrays.size(); ++k) {
    if (arrays[k].array.rows == 0) continue;
    file.go_to(places[k]);
    arrays[k].array.write(nodes, file);
  }
}

}  // namespace pnpbs::io
