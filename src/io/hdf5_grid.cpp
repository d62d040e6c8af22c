// SPDX-License-Identifier: BSD-3-Clause
#include "io/hdf5_grid.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "base/error.hpp"

namespace pnpbs::io {
namespace {

[[noreturn]] void fail_to_lay_out(const std::string& name, int error) {
  throw Error(ErrorKind::file, "cannot write " + name + ": " + std::strerror(error));
}

// Writes the header space and extends the file to its size, to find out whether the disk has room.
// If HDF5 lacks room, some versions abort when the process exits.
void reserve(const char* path, const std::string& name, std::int64_t rows_size) {
  constexpr std::size_t kLayout = std::size_t{1} << 16;
  const std::vector<char> zeros(kLayout);
  const int descriptor = ::open(path, O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) fail_to_lay_out(name, errno);
  const ssize_t wrote = ::write(descriptor, zeros.data(), zeros.size());
  errno = wrote < 0 ? errno : wrote < std::ssize(zeros) ? ENOSPC : 0;
  const bool done = errno == 0 && ::ftruncate(descriptor, std::int64_t{kLayout} + rows_size) == 0;
  const int error = errno;
  if (::close(descriptor) != 0 && done) fail_to_lay_out(name, errno);
  if (!done) fail_to_lay_out(name, error);
}

}  // namespace

std::vector<std::int64_t> lay_out(const OutputFile& output, const std::string& name,
                                  const std::vector<hdf5::Array>& arrays,
                                  const std::function<void(hdf5::NewFile&)>& begin) {
  hdf5::require_hdf5();
  std::int64_t rows_size = 0;
  for (const hdf5::Array& array : arrays) rows_size += array.rows * array.row_size();
  reserve(output.name_aside(), name, rows_size);
  hdf5::NewFile file(output.name_aside(), name);
  begin(file);
  std::vector<std::int64_t> places;
  for (const hdf5::Array& array : arrays) places.push_back(file.add(array));
  file.close();
  if (!output.removed()) return places;
  ::unlink(output.name_aside());  // HDF5 has created it again after a signal removed it
  fail_to_lay_out(name, EINTR);
}

void begin_vtk_grid(hdf5::NewFile& file, std::int64_t points, std::int64_t cells,
                    std::int64_t corners) {
  file.add_group("/VTKHDF");
  file.add_group("/VTKHDF/PointData");
  file.set("/VTKHDF", "Version", std::vector<std::int64_t>{1, 0});
  file.set("/VTKHDF", "Type", std::string("UnstructuredGrid"));
  file.add("/VTKHDF/NumberOfPoints", {points});
  file.add("/VTKHDF/NumberOfCells", {cells});
  file.add("/VTKHDF/NumberOfConnectivityIds", {corners});
}

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
