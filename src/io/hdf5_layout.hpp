// SPDX-License-Identifier: BSD-3-Clause
// How one rank makes a file by HDF5 whose rows all ranks write afterwards.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

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

}  // namespace pnpbs::io
