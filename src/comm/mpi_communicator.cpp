// SPDX-License-Identifier: BSD-3-Clause
// The ranks of an MPI communicator.
#include <algorithm>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>

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
                "MPI is already finalised: nothing can be computed over its ranks any more");
}

void wait_for(std::vector<MPI_Request>& requests) {
  check(MPI_Waitall(count(requests.size()), requests.data(), MPI_STATUSES_IGNORE), "MPI_Waitall");
}

// One message to and from each neighbour.
void post(MPI_Comm comm, int tag, const std::vector<int>& neighbours,
          const std::vector<Bytes>& outgoing, std::vector<Bytes>& incoming,
          std::vector<MPI_Request>& requests) {
  for (std::size_t k = 0; k < neighbours.size(); ++k)
    for_pieces(incoming[k].size(), [&](std::uint64_t at, int length) {
      MPI_Irecv(incoming[k].data() + at, length, MPI_BYTE, neighbours[k], tag, comm,
                &requests.emplace_back());
    });
  for (std::size_t k = 0; k < neighbours.size(); ++k)
    for_pieces(outgoing[k].size(), [&](std::uint64_t at, int length) {
      MPI_Isend(outgoing[k].data() + at, length, MPI_BYTE, neighbours[k], tag, comm,
                &requests.emplace_back());
    });
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

  void start() override { post(comm_, tag_, neighbours_, outgoing_, incoming_, requests_); }
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
    const auto ranks = static_cast<std::size_t>(size_);
    requests_.reserve(2 * ranks);
    sizes_in_.resize(ranks);
    sizes_out_.resize(ranks);
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

  // Sizes first, then the messages, in pieces of limited size: those of a rank that finds no room
  // here are received one by one and dropped, because its neighbours must not wait for ever. All
  // memory is found before the first receive is posted: what is under way must stay where it is.
  std::vector<Bytes> exchange(const std::vector<int>& neighbours,
                              const std::vector<Bytes>& outgoing) const override {
    require_mpi_runs();
    exchange_sizes(neighbours, outgoing);
    std::vector<Bytes> incoming;
    std::exception_ptr failure;
    attempt(failure, [&] {
      incoming.resize(neighbours.size());
      for (std::size_t k = 0; k < neighbours.size(); ++k) incoming[k].resize(sizes_in_[k]);
      reserve_requests(outgoing, incoming);
    });
    if (failure) {
      exchange_in_turn(neighbours, outgoing, nullptr);
      std::rethrow_exception(failure);
    }
    exchange_at_once(neighbours, outgoing, incoming);
    return incoming;
  }

  // Throws for no lack of memory: nobody is ready to be told.
  void exchange_known(const std::vector<int>& neighbours, const std::vector<Bytes>& outgoing,
                      std::vector<Bytes>& incoming) const override {
    std::exception_ptr failure;
    attempt(failure, [&] { reserve_requests(outgoing, incoming); });
    if (!failure) return exchange_at_once(neighbours, outgoing, incoming);
    for (std::size_t k = 0; k < neighbours.size(); ++k) sizes_in_[k] = incoming[k].size();
    exchange_in_turn(neighbours, outgoing, &incoming);
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
    const auto mine = static_cast<std::uint64_t>(value);
    std::uint64_t before = 0;
    check(MPI_Exscan(&mine, &before, 1, MPI_UINT64_T, MPI_SUM, comm_), "MPI_Exscan");
    // MPI leaves that of the first rank open.
    return rank_ == 0 ? 0 : static_cast<std::int64_t>(before);
  }
  void broadcast_bytes(char* bytes, std::size_t n, int root) const override {
    check(MPI_Bcast(bytes, count(n), MPI_BYTE, root, comm_), "MPI_Bcast");
  }
  void allgather_sizes(std::uint64_t mine, std::vector<std::uint64_t>& all) const override {
    check(MPI_Allgather(&mine, 1, MPI_UINT64_T, all.data(), 1, MPI_UINT64_T, comm_),
          "MPI_Allgather");
  }
  void allgather_bytes(const Bytes& mine, const std::vector<int>& sizes,
                       const std::vector<int>& offsets, Bytes& all) const override {
    check(MPI_Allgatherv(mine.data(), count(mine.size()), MPI_BYTE, all.data(), sizes.data(),
                         offsets.data(), MPI_BYTE, comm_),
          "MPI_Allgatherv");
  }
  int message_length(std::uint64_t size) const override { return count(size); }

 private:
  // And those of sparse exchanges. What is waited for later must not meet what comes between.
  static constexpr int kSizeTag = 1, kDataTag = 2, kKnownTag = 6;

  void exchange_sizes(const std::vector<int>& neighbours,
                      const std::vector<Bytes>& outgoing) const {
    requests_.clear();
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
      sizes_out_[k] = outgoing[k].size();
      MPI_Irecv(&sizes_in_[k], 1, MPI_UINT64_T, neighbours[k], kSizeTag, comm_,
                &requests_.emplace_back());
      MPI_Isend(&sizes_out_[k], 1, MPI_UINT64_T, neighbours[k], kSizeTag, comm_,
                &requests_.emplace_back());
    }
    wait_for(requests_);
  }

  void reserve_requests(const std::vector<Bytes>& outgoing,
                        const std::vector<Bytes>& incoming) const {
    std::uint64_t pieces = 0;
    for (const Bytes& bytes : outgoing) pieces += mpi::pieces(bytes.size());
    for (const Bytes& bytes : incoming) pieces += mpi::pieces(bytes.size());
    requests_.reserve(pieces);
  }

  void exchange_at_once(const std::vector<int>& neighbours, const std::vector<Bytes>& outgoing,
                        std::vector<Bytes>& incoming) const {
    requests_.clear();
    post(comm_, kDataTag, neighbours, outgoing, incoming, requests_);
    wait_for(requests_);
  }

  // Needs no memory: a piece to and from one neighbour at a time. What comes goes to `incoming`, or
  // is dropped if that is NULL. Ranks that do this take their pairs in the same order, that of the
  // lower rank and then the higher one, so that no ring of them waits for each other.
  void exchange_in_turn(const std::vector<int>& neighbours, const std::vector<Bytes>& outgoing,
                        std::vector<Bytes>* incoming) const {
    const auto pair_with = [this](int other) {
      return std::pair(std::min(rank_, other), std::max(rank_, other));
    };
    std::pair<int, int> last(-1, -1);
    for (std::size_t n = 0; n < neighbours.size(); ++n) {
      std::size_t next = neighbours.size();
      for (std::size_t k = 0; k < neighbours.size(); ++k)
        if (pair_with(neighbours[k]) > last &&
            (next == neighbours.size() || pair_with(neighbours[k]) < pair_with(neighbours[next])))
          next = k;
      last = pair_with(neighbours[next]);
      exchange_with(neighbours[next], outgoing[next], sizes_in_[next],
                    incoming ? (*incoming)[next].data() : nullptr);
    }
  }

  void exchange_with(int neighbour, const Bytes& outgoing, std::uint64_t size, char* to) const {
    const std::uint64_t end = std::max<std::uint64_t>(outgoing.size(), size);
    const auto partner = [&](bool any) { return any ? neighbour : MPI_PROC_NULL; };
    const auto length_of = [](std::uint64_t all, std::uint64_t at) {
      return at < all ? static_cast<int>(std::min<std::uint64_t>(kPiece, all - at)) : 0;
    };
    for (std::uint64_t at = 0; at < end; at += kPiece) {
      const int sent = length_of(outgoing.size(), at), received = length_of(size, at);
      check(
          MPI_Sendrecv(sent > 0 ? outgoing.data() + at : nullptr, sent, MPI_BYTE, partner(sent > 0),
                       kDataTag, to && received > 0 ? to + at : dropped_.get(), received, MPI_BYTE,
                       partner(received > 0), kDataTag, comm_, MPI_STATUS_IGNORE),
          "MPI_Sendrecv");
    }
  }

  static void combine(void* in, void* in_out, int* length, MPI_Datatype*) {
    const auto* from = static_cast<const Reduction*>(in);
    auto* to = static_cast<Reduction*>(in_out);
    for (int i = 0; i < *length; ++i) {
      to[i].failed = std::max(to[i].failed, from[i].failed);
      to[i].sum.add(from[i].sum);
      to[i].max = std::max(to[i].max, from[i].max);
    }
  }

  MPI_Comm comm_ = MPI_COMM_NULL;
  MPI_Datatype reduction_ = MPI_DATATYPE_NULL;
  MPI_Op combining_ = MPI_OP_NULL;
  int rank_ = 0, size_ = 1, ranks_on_node_ = 1;
  // Kept, so that exchanges need no memory: requests, and the sizes of messages from and to as many
  // neighbours as there may be.
  mutable std::vector<MPI_Request> requests_;
  mutable std::vector<std::uint64_t> sizes_in_, sizes_out_;
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
