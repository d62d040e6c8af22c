// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/communicator.hpp"

#include <cstring>
#include <new>

#include "core/build_config.hpp"
#include "core/error.hpp"

#if PNPBS_HAVE_MPI
#include <mpi.h>

#include "parallel/mpi_file.hpp"
#endif

namespace pnpbs {

namespace {

class SerialCommunicator : public Communicator {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  int ranks_on_node() const override { return 1; }
  std::uint64_t sum(std::uint64_t value) const override { return value; }
  double largest(double value) const override { return value; }
  void sum(std::vector<std::int64_t>&) const override {}
  void broadcast(Bytes&, int) const override {}
  std::vector<Bytes> gather(const Bytes& bytes) const override { return {bytes}; }
  std::vector<Bytes> exchange(const std::vector<int>&, const std::vector<Bytes>&) const override {
    return {};
  }
  void exchange_known(const std::vector<int>&, const std::vector<Bytes>&,
                      std::vector<Bytes>&) const override {}
  std::unique_ptr<RankFile> open_file(const std::string& path,
                                      const std::string& name) const override {
    return open_alone(path, name);
  }
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
  void sum(std::vector<std::int64_t>& values) const override {
    check(MPI_Allreduce(MPI_IN_PLACE, values.data(), count(values.size()), MPI_INT64_T, MPI_SUM,
                        comm_),
          "MPI_Allreduce");
  }
  void broadcast(Bytes& bytes, int root) const override {
    std::uint64_t size = bytes.size();
    check(MPI_Bcast(&size, 1, MPI_UINT64_T, root, comm_), "MPI_Bcast");
    bytes.resize(size);
    check(MPI_Bcast(bytes.data(), count(size), MPI_BYTE, root, comm_), "MPI_Bcast");
  }

  std::vector<Bytes> gather(const Bytes& bytes) const override {
    const int mine = count(bytes.size());
    std::vector<int> sizes(static_cast<std::size_t>(size_)), offsets(sizes.size());
    check(MPI_Allgather(&mine, 1, MPI_INT, sizes.data(), 1, MPI_INT, comm_), "MPI_Allgather");
    std::size_t total = 0;
    for (std::size_t r = 0; r < sizes.size(); ++r) {
      offsets[r] = count(total);
      total += static_cast<std::size_t>(sizes[r]);
    }
    Bytes all(total);
    check(MPI_Allgatherv(bytes.data(), mine, MPI_BYTE, all.data(), sizes.data(), offsets.data(),
                         MPI_BYTE, comm_),
          "MPI_Allgatherv");
    std::vector<Bytes> parts;
    for (std::size_t r = 0; r < sizes.size(); ++r)
      parts.emplace_back(all.begin() + offsets[r], all.begin() + offsets[r] + sizes[r]);
    return parts;
  }

  // Sizes first, then the messages; all non-blocking.
  std::vector<Bytes> exchange(const std::vector<int>& neighbours,
                              const std::vector<Bytes>& outgoing) const override {
    const std::size_t n = neighbours.size();
    std::vector<std::uint64_t> sizes_out(n), sizes_in(n);
    std::vector<MPI_Request> requests(2 * n);
    for (std::size_t k = 0; k < n; ++k) {
      sizes_out[k] = outgoing[k].size();
      MPI_Irecv(&sizes_in[k], 1, MPI_UINT64_T, neighbours[k], kSizeTag, comm_, &requests[k]);
      MPI_Isend(&sizes_out[k], 1, MPI_UINT64_T, neighbours[k], kSizeTag, comm_, &requests[n + k]);
    }
    check(MPI_Waitall(static_cast<int>(2 * n), requests.data(), MPI_STATUSES_IGNORE),
          "MPI_Waitall");
    std::vector<Bytes> incoming(n);
    for (std::size_t k = 0; k < n; ++k) incoming[k].resize(sizes_in[k]);
    exchange_known(neighbours, outgoing, incoming);
    return incoming;
  }

  void exchange_known(const std::vector<int>& neighbours, const std::vector<Bytes>& outgoing,
                      std::vector<Bytes>& incoming) const override {
    const std::size_t n = neighbours.size();
    requests_.resize(2 * n);
    for (std::size_t k = 0; k < n; ++k)
      MPI_Irecv(incoming[k].data(), count(incoming[k].size()), MPI_BYTE, neighbours[k], kDataTag,
                comm_, &requests_[k]);
    for (std::size_t k = 0; k < n; ++k)
      MPI_Isend(outgoing[k].data(), count(outgoing[k].size()), MPI_BYTE, neighbours[k], kDataTag,
                comm_, &requests_[n + k]);
    check(MPI_Waitall(static_cast<int>(2 * n), requests_.data(), MPI_STATUSES_IGNORE),
          "MPI_Waitall");
  }

  std::unique_ptr<RankFile> open_file(const std::string& path,
                                      const std::string& name) const override {
    std::unique_ptr<RankFile> file;
    std::exception_ptr failure;
    try {
      file = size_ == 1 ? open_alone(path, name) : open_by_mpi(comm_, path, name);
    } catch (...) {
      failure = std::current_exception();
    }
    try {
      agree_on_failure(*this, failure);
    } catch (...) {
      // Closing is collective and would wait for the ranks that could not open it.
      if (!failure) (void)file.release();
      throw;
    }
    return file;
  }

 private:
  static constexpr int kSizeTag = 1, kDataTag = 2;

  static int count(std::size_t n) {
    if (n > 0x7fffffff)
      throw Error(PNPBS_ERROR_MPI, "a message of " + std::to_string(n) +
                                       " entries is longer than MPI takes: use more ranks");
    return static_cast<int>(n);
  }
  static void check(int code, const char* call) {
    if (code != MPI_SUCCESS)
      throw Error(PNPBS_ERROR_MPI, std::string(call) + " failed with code " + std::to_string(code));
  }

  MPI_Comm comm_ = MPI_COMM_NULL;
  int rank_ = 0, size_ = 1, ranks_on_node_ = 1;
  mutable std::vector<MPI_Request> requests_;
};

#endif

// Status and text of an exception, for the others.
Bytes describe(std::exception_ptr failure) {
  std::int32_t status = PNPBS_ERROR_INTERNAL;
  std::string text = "unknown failure";
  try {
    std::rethrow_exception(failure);
  } catch (const Error& error) {
    status = error.status();
    text = error.what();
  } catch (const std::bad_alloc&) {
    status = PNPBS_ERROR_MEMORY;
    text = "out of memory: fewer nodes (a larger spacing) or more memory is needed";
  } catch (const std::exception& error) {
    text = error.what();
  } catch (...) {
    status = PNPBS_ERROR_CALLBACK;
    text = "a callback threw something that is no std::exception";
  }
  Bytes bytes(sizeof status + text.size());
  std::memcpy(bytes.data(), &status, sizeof status);
  std::memcpy(bytes.data() + sizeof status, text.data(), text.size());
  return bytes;
}

}  // namespace

void agree_on_failure(const Communicator& comm, std::exception_ptr failure) {
  if (comm.size() == 1) {
    if (failure) std::rethrow_exception(failure);
    return;
  }
  // The lowest failed rank is the largest of size - rank.
  const int mine = failure ? comm.size() - comm.rank() : 0;
  const int found = static_cast<int>(comm.largest(mine));
  if (found == 0) return;
  const int failed = comm.size() - found;
  Bytes bytes;
  if (comm.rank() == failed) bytes = describe(failure);
  comm.broadcast(bytes, failed);
  std::int32_t status;
  std::memcpy(&status, bytes.data(), sizeof status);
  throw Error(static_cast<pnpbs_status>(status),
              "rank " + std::to_string(failed) + ": " +
                  std::string(bytes.data() + sizeof status, bytes.size() - sizeof status));
}

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
