// SPDX-License-Identifier: BSD-3-Clause
// A SharedWriter on MPI-IO, which also works on network file systems. Compiled only in builds with
// MPI.
#pragma once

#include "comm/shared_writer.hpp"

namespace pnpbs {

// Opens an existing file. Local, because in some implementations a collective opening waits forever
// if one rank fails. Throws Error(ErrorKind::file).
std::unique_ptr<SharedWriter> open_by_mpi(const std::string& path, const std::string& name);

}  // namespace pnpbs
