// SPDX-License-Identifier: BSD-3-Clause
// Helpers for calls of MPI. Compiled only in builds with MPI.
#pragma once

#include <mpi.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "base/error.hpp"

namespace pnpbs::mpi {

// Throws Error(ErrorKind::mpi) unless `code` is MPI_SUCCESS.
inline void check(int code, const char* call) {
  if (code != MPI_SUCCESS)
    throw Error(ErrorKind::mpi, std::string(call) + " failed with code " + std::to_string(code));
}

// Converts the length of a message to the type of MPI. Throws if it is too long.
inline int count(std::size_t n) {
  if (n > 0x7fffffff)
    throw Error(ErrorKind::mpi, "a message of " + std::to_string(n) +
                                    " entries is longer than MPI takes: use more ranks");
  return static_cast<int>(n);
}

// Long messages are sent in pieces, so that they can be received and dropped even if there is no
// memory for them.
constexpr int kPiece = 1 << 18;  // bytes

// Returns the number of pieces of a message of `size` bytes.
inline std::uint64_t pieces(std::uint64_t size) { return (size + kPiece - 1) / kPiece; }

// Calls visit(offset, length) for each piece of a message of `size` bytes.
template <class Visit>
void for_pieces(std::uint64_t size, const Visit& visit) {
  for (std::uint64_t at = 0; at < size; at += kPiece)
    visit(at, static_cast<int>(std::min<std::uint64_t>(kPiece, size - at)));
}

}  // namespace pnpbs::mpi
