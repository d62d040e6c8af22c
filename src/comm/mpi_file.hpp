// SPDX-License-Identifier: BSD-3-Clause
// A SharedWriter by MPI-IO, which knows how to share a file over the network; only in builds with
// MPI.
#pragma once

#include "comm/shared_writer.hpp"

namespace pnpbs {

// The file must exist. Each rank opens it by itself: where one cannot, a collective opening waits
// for ever in some implementations. Throws Error(ErrorKind::file).
std::unique_ptr<SharedWriter> open_by_mpi(const std::string& path, const std::string& name);

}  // namespace pnpbs
