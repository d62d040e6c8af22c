// SPDX-License-Identifier: BSD-3-Clause
// The processes that place nodes together. Serial: one process, no MPI call ever.
#pragma once

#include <cstdint>
#include <memory>

namespace pnpbs {

class Communicator {
 public:
  virtual ~Communicator() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  // Collective; integers and maxima only, so that no result depends on the order of ranks.
  virtual std::uint64_t sum(std::uint64_t value) const = 0;  // modulo 2^64
  virtual double largest(double value) const = 0;
  // Ranks of this communicator on this node: they share its cores.
  virtual int ranks_on_node() const = 0;
};

std::shared_ptr<Communicator> serial_communicator();

// A duplicate of the communicator with this Fortran handle. Collective. Throws
// Error(PNPBS_ERROR_MPI or _UNSUPPORTED).
std::shared_ptr<Communicator> mpi_communicator(std::int32_t fortran_handle);

}  // namespace pnpbs
