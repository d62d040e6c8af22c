// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/communicator.hpp"

#include <string>

#include "core/build_config.hpp"
#include "core/error.hpp"

#if PNPBS_HAVE_MPI
#include <mpi.h>
#endif

namespace pnpbs {

namespace {

class SerialCommunicator : public Communicator {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  std::uint64_t sum(std::uint64_t value) const override { return value; }
  double largest(double value) const override { return value; }
  int ranks_on_node() const override { return 1; }
};

#if PNPBS_HAVE_MPI

class MpiCommunicator : public Communicator {
 public:
  explicit MpiCommunicator(MPI_Comm parent) {
    check(MPI_Comm_dup(parent, &comm_), "MPI_Comm_dup");
    MPI_Comm_rank(comm_, &rank_);
    MPI_Comm_size(comm_, &size_);
    MPI_Comm node;
    check(MPI_Comm_split_type(comm_, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node),
          "MPI_Comm_split_type");
    MPI_Comm_size(node, &ranks_on_node_);
    MPI_Comm_free(&node);
  }
  MpiCommunicator(const MpiCommunicator&) = delete;
  MpiCommunicator& operator=(const MpiCommunicator&) = delete;
  ~MpiCommunicator() override {
    int finalized = 0;
    MPI_Finalized(&finalized);
    if (!finalized) MPI_Comm_free(&comm_);  // after MPI_Finalize it would abort
  }

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  int ranks_on_node() const override { return ranks_on_node_; }
  std::uint64_t sum(std::uint64_t value) const override {
    std::uint64_t total = 0;
    check(MPI_Allreduce(&value, &total, 1, MPI_UINT64_T, MPI_SUM, comm_), "MPI_Allreduce");
    return total;
  }
  double largest(double value) const override {
    double most = 0;
    check(MPI_Allreduce(&value, &most, 1, MPI_DOUBLE, MPI_MAX, comm_), "MPI_Allreduce");
    return most;
  }

 private:
  static void check(int code, const char* call) {
    if (code != MPI_SUCCESS)
      throw Error(PNPBS_ERROR_MPI, std::string(call) + " failed with code " + std::to_string(code));
  }

  MPI_Comm comm_ = MPI_COMM_NULL;
  int rank_ = 0, size_ = 1, ranks_on_node_ = 1;
};

#endif

}  // namespace

std::shared_ptr<Communicator> serial_communicator() {
  return std::make_shared<SerialCommunicator>();
}

#if PNPBS_HAVE_MPI

std::shared_ptr<Communicator> mpi_communicator(std::int32_t fortran_handle) {
  int initialized = 0, finalized = 0;
  MPI_Initialized(&initialized);
  if (!initialized)
    throw Error(PNPBS_ERROR_MPI,
                "MPI is not initialised: call MPI_Init first, or use "
                "pnpbs_context_create_serial");
  MPI_Finalized(&finalized);
  if (finalized) throw Error(PNPBS_ERROR_MPI, "MPI is already finalised");
  const MPI_Comm comm = MPI_Comm_f2c(static_cast<MPI_Fint>(fortran_handle));
  if (comm == MPI_COMM_NULL)
    throw Error(PNPBS_ERROR_MPI, "the communicator (Fortran handle " +
                                     std::to_string(fortran_handle) + ") is MPI_COMM_NULL");
  int size = 1;
  MPI_Comm_size(comm, &size);
  if (size > 1)
    throw Error(PNPBS_ERROR_UNSUPPORTED,
                "the communicator has " + std::to_string(size) +
                    " ranks; this version places nodes on one rank only: pass MPI_COMM_SELF");
  return std::make_shared<MpiCommunicator>(comm);
}

#else

std::shared_ptr<Communicator> mpi_communicator(std::int32_t) {
  throw Error(PNPBS_ERROR_UNSUPPORTED,
              "this library was built without MPI (PNPBS_ENABLE_MPI=OFF); use "
              "pnpbs_context_create_serial");
}

#endif

}  // namespace pnpbs
