// SPDX-License-Identifier: BSD-3-Clause
// The ranks of an MPI communicator.
#include <algorithm>
#include <memory>
#include <new>
#include <optional>
#include <string>

#include "base/build_config.hpp"
#include "comm/communicator.hpp"

#if PNPBS_HAVE_MPI
#include <mpi.h>

#include "comm/mpi_calls.hpp"
#include "comm/mpi_file.hpp"
#include "comm/mpi_sparse_exchange.hpp"
#endif

namespace pnpbs {

#if PNPBS_HAVE_MPI

namespace {

using mpi::check;
using mpi::count;
using mpi::for_pieces;
using mpi::kPiece;

// After it has ended MPI would abort the process. Asked where calls begin to talk.
void require_mpi_runs() {
  int finalized = 0;
  MPI_Finalized(&finalized);
  if (finalized)
    throw Error(ErrorKind::mpi,
                "MPI is already finalised: what is computed over its ranks must come before");
}

void wait_for(std::vector<MPI_Request>& requests) {
  check(MPI_Waitall(count(requests.size()), requests.data(), MPI_STATUSES_IGNORE), "MPI_Waitall");
}

class MpiKnownExchange : public KnownExchange {
 public:
  MpiKnownExchange(MPI_Comm comm, int tag, const std::vector<int>& neighbours,
                   const std::vector<Bytes>& outgoing, std::vector<Bytes>& incoming)
      : comm_(comm), tag_(tag), neighbours_(neighbours), outgoing_(outgoing), incoming_(incoming) {
    std::uint64_t messages = 0;
    for (const Bytes& bytes : outgoing) messages += mpi::pieces(bytes.size());
    for (const Bytes& bytes : incoming) messages += mpi::pieces(bytes.size());
    requests_.reserve(messages);
  }
  MpiKnownExchange(const MpiKnownExchange&) = delete;
  MpiKnownExchange& operator=(const MpiKnownExchange&) = delete;
  ~MpiKnownExchange() override {
    int finalized = 0;
    MPI_Finalized(&finalized);
    if (!finalized && !requests_.empty())
      MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  }

  void start() override {
    for (std::size_t k = 0; k < neighbours_.size(); ++k)
      for_pieces(incoming_[k].size(), [&](std::uint64_t at, int length) {
        MPI_Irecv(incoming_[k].data() + at, length, MPI_BYTE, neighbours_[k], tag_, comm_,
                  &requests_.emplace_back());
      });
    for (std::size_t k = 0; k < neighbours_.size(); ++k)
      for_pieces(outgoing_[k].size(), [&](std::uint64_t at, int length) {
        MPI_Isend(outgoing_[k].data() + at, length, MPI_BYTE, neighbours_[k], tag_, comm_,
                  &requests_.emplace_back());
      });
  }
  void wait() override {
    require_mpi_runs();
    wait_for(requests_);
    requests_.clear();
  }

 private:
  MPI_Comm comm_;
  int tag_;
  const std::vector<int> neighbours_;
  const std::vector<Bytes>& outgoing_;
  std::vector<Bytes>& incoming_;
  std::vector<MPI_Request> requests_;  // under way
};

class MpiCommunicator : public Communicator {
 public:
  explicit MpiCommunicator(MPI_Comm parent) {
    check(MPI_Comm_dup(parent, &comm_), "MPI_Comm_dup");
    MPI_Comm_set_errhandler(comm_, MPI_ERRORS_RETURN);  // nothing of ours ends the process
    MPI_Comm_rank(comm_, &rank_);
    MPI_Comm_size(comm_, &size_);
    MPI_Comm node;
    check(MPI_Comm_split_type(comm_, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node),
          "MPI_Comm_split_type");
    MPI_Comm_size(node, &ranks_on_node_);
    MPI_Comm_free(&node);
    check(MPI_Type_contiguous(sizeof(Reduction), MPI_BYTE, &reduction_), "MPI_Type_contiguous");
    check(MPI_Type_commit(&reduction_), "MPI_Type_commit");
    check(MPI_Op_create(combine, 1, &combining_), "MPI_Op_create");
  }
  MpiCommunicator(const MpiCommunicator&) = delete;
  MpiCommunicator& operator=(const MpiCommunicator&) = delete;
  ~MpiCommunicator() override {
    int finalized = 0;
    MPI_Finalized(&finalized);
    if (finalized) return;  // to free anything would abort
    MPI_Op_free(&combining_);
    MPI_Type_free(&reduction_);
    MPI_Comm_free(&comm_);
  }

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  int ranks_on_node() const override { return ranks_on_node_; }

  // Sizes first, then the messages, in pieces of limited size: those of a message that finds no
  // room here are received one by one and dropped, because its sender must not wait for ever.
  std::vector<Bytes> exchange(const std::vector<int>& neighbours,
                              const std::vector<Bytes>& outgoing) const override {
    require_mpi_runs();
    const std::size_t n = neighbours.size();
    std::vector<std::uint64_t> sizes_out(n), sizes_in(n);
    std::vector<MPI_Request> requests(2 * n);
    for (std::size_t k = 0; k < n; ++k) {
      sizes_out[k] = outgoing[k].size();
      MPI_Irecv(&sizes_in[k], 1, MPI_UINT64_T, neighbours[k], kSizeTag, comm_, &requests[k]);
      MPI_Isend(&sizes_out[k], 1, MPI_UINT64_T, neighbours[k], kSizeTag, comm_, &requests[n + k]);
    }
    wait_for(requests);
    requests.clear();
    std::vector<Bytes> incoming(n);
    std::vector<std::size_t> dropped;
    for (std::size_t k = 0; k < n; ++k) {
      try {
        incoming[k].resize(sizes_in[k]);
        for_pieces(sizes_in[k], [&](std::uint64_t at, int length) {
          MPI_Irecv(incoming[k].data() + at, length, MPI_BYTE, neighbours[k], kDataTag, comm_,
                    &requests.emplace_back());
        });
      } catch (const std::bad_alloc&) {
        dropped.push_back(k);
      }
    }
    for (std::size_t k = 0; k < n; ++k)
      for_pieces(sizes_out[k], [&](std::uint64_t at, int length) {
        MPI_Isend(outgoing[k].data() + at, length, MPI_BYTE, neighbours[k], kDataTag, comm_,
                  &requests.emplace_back());
      });
    for (const std::size_t k : dropped)
      for_pieces(sizes_in[k], [&](std::uint64_t, int length) {
        MPI_Recv(dropped_.get(), length, MPI_BYTE, neighbours[k], kDataTag, comm_,
                 MPI_STATUS_IGNORE);
      });
    wait_for(requests);
    if (!dropped.empty()) throw std::bad_alloc();
    return incoming;
  }

  void exchange_known(const std::vector<int>& neighbours, const std::vector<Bytes>& outgoing,
                      std::vector<Bytes>& incoming) const override {
    requests_.clear();
    for (std::size_t k = 0; k < neighbours.size(); ++k)
      for_pieces(incoming[k].size(), [&](std::uint64_t at, int length) {
        MPI_Irecv(incoming[k].data() + at, length, MPI_BYTE, neighbours[k], kDataTag, comm_,
                  &requests_.emplace_back());
      });
    for (std::size_t k = 0; k < neighbours.size(); ++k)
      for_pieces(outgoing[k].size(), [&](std::uint64_t at, int length) {
        MPI_Isend(outgoing[k].data() + at, length, MPI_BYTE, neighbours[k], kDataTag, comm_,
                  &requests_.emplace_back());
      });
    wait_for(requests_);
  }

  std::unique_ptr<KnownExchange> known_exchange(const std::vector<int>& neighbours,
                                                const std::vector<Bytes>& outgoing,
                                                std::vector<Bytes>& incoming) const override {
    return std::make_unique<MpiKnownExchange>(comm_, kKnownTag, neighbours, outgoing, incoming);
  }

  // The agreement at its end keeps the next exchange from mixing with this one: nobody begins that
  // before all have stopped receiving.
  std::vector<Message> sparse_all_to_all(const std::vector<Message>& outgoing) const override {
    std::vector<Message> incoming;
    std::optional<MpiSparseExchange> exchange;
    std::exception_ptr failure;
    attempt(failure, [&] {
      for (const Message& message : outgoing)
        if (message.rank == rank_) incoming.push_back(message);
      exchange.emplace(comm_, rank_, outgoing);
    });
    agree_on_failure(*this, failure);
    if (size_ == 1) return incoming;
    exchange->run(incoming, dropped_.get(), failure);
    agree_on_failure(*this, failure);
    std::sort(incoming.begin(), incoming.end(),
              [](const Message& a, const Message& b) { return a.rank < b.rank; });
    return incoming;
  }

  std::unique_ptr<RankFile> open_file(const std::string& path,
                                      const std::string& name) const override {
    std::unique_ptr<RankFile> file;
    agreed(*this, [&] { file = size_ == 1 ? open_alone(path, name) : open_by_mpi(path, name); });
    return file;
  }

 protected:
  Reduction reduce(const Reduction& mine) const override {
    require_mpi_runs();
    Reduction all;
    check(MPI_Allreduce(&mine, &all, 1, reduction_, combining_, comm_), "MPI_Allreduce");
    return all;
  }
  void sum_entries(std::vector<std::int64_t>& values) const override {
    check(MPI_Allreduce(MPI_IN_PLACE, values.data(), count(values.size()), MPI_INT64_T, MPI_SUM,
                        comm_),
          "MPI_Allreduce");
  }
  std::int64_t exclusive_scan(std::int64_t value) const override {
    std::int64_t before = 0;
    check(MPI_Exscan(&value, &before, 1, MPI_INT64_T, MPI_SUM, comm_), "MPI_Exscan");
    return rank_ == 0 ? 0 : before;  // MPI leaves that of the first rank open
  }
  void broadcast_bytes(char* bytes, std::size_t n, int root) const override {
    check(MPI_Bcast(bytes, count(n), MPI_BYTE, root, comm_), "MPI_Bcast");
  }
  std::vector<std::uint64_t> allgather_sizes(std::uint64_t mine) const override {
    std::vector<std::uint64_t> all(static_cast<std::size_t>(size_));
    check(MPI_Allgather(&mine, 1, MPI_UINT64_T, all.data(), 1, MPI_UINT64_T, comm_),
          "MPI_Allgather");
    return all;
  }
  void allgather_bytes(const Bytes& mine, const std::vector<std::uint64_t>& sizes,
                       Bytes& all) const override {
    count(all.size());  // offsets are no longer either
    std::vector<int> counts, offsets;
    int offset = 0;
    for (const std::uint64_t size : sizes) {
      offsets.push_back(offset);
      counts.push_back(static_cast<int>(size));
      offset += counts.back();
    }
    check(MPI_Allgatherv(mine.data(), count(mine.size()), MPI_BYTE, all.data(), counts.data(),
                         offsets.data(), MPI_BYTE, comm_),
          "MPI_Allgatherv");
  }

 private:
  // And those of sparse exchanges. What is waited for later must not meet what comes between.
  static constexpr int kSizeTag = 1, kDataTag = 2, kKnownTag = 6;

  static void combine(void* in, void* in_out, int* length, MPI_Datatype*) {
    const auto* from = static_cast<const Reduction*>(in);
    auto* to = static_cast<Reduction*>(in_out);
    for (int i = 0; i < *length; ++i) {
      to[i].failed = std::max(to[i].failed, from[i].failed);
      to[i].sum += from[i].sum;
      to[i].max = std::max(to[i].max, from[i].max);
    }
  }

  MPI_Comm comm_ = MPI_COMM_NULL;
  MPI_Datatype reduction_ = MPI_DATATYPE_NULL;
  MPI_Op combining_ = MPI_OP_NULL;
  int rank_ = 0, size_ = 1, ranks_on_node_ = 1;
  mutable std::vector<MPI_Request> requests_;  // of renewals: kept, so that they need no memory
  std::unique_ptr<char[]> dropped_ = std::make_unique<char[]>(kPiece);
};

}  // namespace

std::shared_ptr<Communicator> mpi_communicator(std::int32_t fortran_handle) {
  int initialized = 0, finalized = 0;
  MPI_Initialized(&initialized);
  if (!initialized)
    throw Error(ErrorKind::mpi,
                "MPI is not initialised: call MPI_Init first, or use "
                "pnpbs_context_create_serial");
  MPI_Finalized(&finalized);
  if (finalized) throw Error(ErrorKind::mpi, "MPI is already finalised");
  const MPI_Comm comm = MPI_Comm_f2c(static_cast<MPI_Fint>(fortran_handle));
  if (comm == MPI_COMM_NULL)
    throw Error(ErrorKind::mpi, "the communicator (Fortran handle " +
                                    std::to_string(fortran_handle) + ") is MPI_COMM_NULL");
  return std::make_shared<MpiCommunicator>(comm);
}

void require_our_mpi(const std::string& library) {
  // Fortran strings come padded with blanks, C ones sometimes with the end of a line.
  const auto trimmed = [](const std::string& text) {
    const std::size_t last = text.find_last_not_of(" \n\t\r");
    return last == std::string::npos ? std::string() : text.substr(0, last + 1);
  };
  const auto first_line = [](const std::string& text) { return text.substr(0, text.find('\n')); };
  char version[MPI_MAX_LIBRARY_VERSION_STRING] = "";
  int length = 0;
  check(MPI_Get_library_version(version, &length), "MPI_Get_library_version");
  const std::string theirs = trimmed(library), ours = trimmed(version);
  if (theirs == ours) return;
  throw Error(ErrorKind::mpi, "the communicator is one of another MPI library, \"" +
                                  first_line(theirs) + "\"; PNPBS calls \"" + first_line(ours) +
                                  "\" (built with " PNPBS_MPI_LIBRARY_TEXT
                                  "): build PNPBS with the MPI of the program");
}

#else

namespace {

[[noreturn]] void throw_no_mpi() {
  throw Error(ErrorKind::unsupported,
              "this library was built without MPI (PNPBS_ENABLE_MPI=OFF); use "
              "pnpbs_context_create_serial");
}

}  // namespace

std::shared_ptr<Communicator> mpi_communicator(std::int32_t) { throw_no_mpi(); }

void require_our_mpi(const std::string&) { throw_no_mpi(); }

#endif

}  // namespace pnpbs
