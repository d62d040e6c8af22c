// SPDX-License-Identifier: BSD-3-Clause
// A communicator on top of MPI.
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
#include "comm/mpi_messages.hpp"
#include "comm/mpi_sparse_exchange.hpp"
#endif

namespace pnpbs {

#if PNPBS_HAVE_MPI

namespace {

using mpi::check;
using mpi::count;
using mpi::kPiece;
using mpi::pieces;

bool mpi_has_ended() {
  int finalized = 0;
  MPI_Finalized(&finalized);
  return finalized != 0;
}

// Throws if MPI has ended, because MPI would then abort the process. Called before the first
// communication of an operation.
void require_mpi_runs() {
  if (mpi_has_ended())
    throw Error(ErrorKind::mpi,
                "MPI is already finalised: nothing can be computed over its ranks any more");
}

std::uint64_t pieces_of(const std::vector<Bytes>& messages) {
  std::uint64_t all = 0;
  for (const Bytes& bytes : messages) all += pieces(bytes.size());
  return all;
}

// Posts one message to and from each neighbour, in pieces. The memory must have been reserved.
void post(MPI_Comm comm, int tag, const std::vector<int>& neighbours,
          const std::vector<Bytes>& outgoing, std::vector<Bytes>& incoming, MpiMessages& messages) {
  for (std::size_t k = 0; k < neighbours.size(); ++k)
    mpi::for_pieces(incoming[k].size(), [&](std::uint64_t at, int length) {
      messages.receive(incoming[k].data() + at, length, neighbours[k], tag, comm);
    });
  for (std::size_t k = 0; k < neighbours.size(); ++k)
    mpi::for_pieces(outgoing[k].size(), [&](std::uint64_t at, int length) {
      messages.send(outgoing[k].data() + at, length, neighbours[k], tag, comm);
    });
}

class MpiCommunicator : public Communicator {
 public:
  // Allocates memory for the largest possible number of neighbours, so that exchanges allocate
  // none.
  explicit MpiCommunicator(int ranks) : sizes_in_(index(ranks)), sizes_out_(index(ranks)) {
    messages_.reserve(2 * static_cast<std::uint64_t>(ranks));
  }
  MpiCommunicator(const MpiCommunicator&) = delete;
  MpiCommunicator& operator=(const MpiCommunicator&) = delete;
  ~MpiCommunicator() override {
    if (mpi_has_ended()) return;  // MPI aborts if an object is freed now
    if (combining_ != MPI_OP_NULL) MPI_Op_free(&combining_);
    if (reduction_ != MPI_DATATYPE_NULL) MPI_Type_free(&reduction_);
    if (comm_ != MPI_COMM_NULL) MPI_Comm_free(&comm_);
  }

  // Duplicates the communicator. Collective.
  void connect(MPI_Comm parent) {
    check(MPI_Comm_dup(parent, &comm_), "MPI_Comm_dup");
    // Errors of MPI are returned as codes and do not end the process.
    check(MPI_Comm_set_errhandler(comm_, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
    check(MPI_Comm_rank(comm_, &rank_), "MPI_Comm_rank");
    check(MPI_Comm_size(comm_, &size_), "MPI_Comm_size");
    MPI_Comm node;
    check(MPI_Comm_split_type(comm_, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node),
          "MPI_Comm_split_type");
    const int code = MPI_Comm_size(node, &ranks_on_node_);
    check(MPI_Comm_free(&node), "MPI_Comm_free");
    check(code, "MPI_Comm_size");
    check(MPI_Type_contiguous(sizeof(Reduction), MPI_BYTE, &reduction_), "MPI_Type_contiguous");
    check(MPI_Type_commit(&reduction_), "MPI_Type_commit");
    check(MPI_Op_create(combine, 1, &combining_), "MPI_Op_create");
  }

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  int ranks_on_node() const override { return ranks_on_node_; }

  void reserve_messages(std::size_t count) const override {
    if (count <= sizes_in_.size()) return;
    messages_.reserve(2 * count);
    sizes_out_.resize(count);
    sizes_in_.resize(count);
  }

  // The sizes are exchanged first. Then each rank allocates its memory, and the messages are sent
  // only if all ranks have succeeded.
  std::vector<Bytes> exchange(const std::vector<int>& neighbours,
                              const std::vector<Bytes>& outgoing,
                              std::exception_ptr failure) const override {
    std::vector<Bytes> incoming;
    MpiMessages messages;
    run_and_keep(failure, [&] { exchange_sizes(neighbours, outgoing); });
    attempt(failure, [&] {
      incoming.resize(neighbours.size());
      for (std::size_t k = 0; k < neighbours.size(); ++k) incoming[k].resize(sizes_in_[k]);
      messages.reserve(pieces_of(outgoing) + pieces_of(incoming));
    });
    agree_on_failure(*this, failure);
    const WaitTimer timer(*this);
    post(comm_, tag(kDataTag), neighbours, outgoing, incoming, messages);
    messages.wait();
    return incoming;
  }

  std::unique_ptr<PersistentExchange> persistent_exchange(
      const std::vector<int>& neighbours, const std::vector<Bytes>& outgoing,
      std::vector<Bytes>& incoming) const override {
    return std::make_unique<MpiPersistentExchange>(*this, neighbours, outgoing, incoming);
  }

  // The agreement at the end separates consecutive exchanges: no rank begins the next one before
  // all have stopped receiving.
  std::vector<Message> sparse_all_to_all(const std::vector<Message>& outgoing) const override {
    std::vector<Message> incoming;
    std::optional<MpiSparseExchange> exchange;
    std::exception_ptr failure;
    attempt(failure, [&] {
      for (const Message& message : outgoing)
        if (message.rank == rank_) incoming.push_back(message);
      exchange.emplace(comm_, rank_, tag(kSparseTag), outgoing);
    });
    agree_on_failure(*this, failure);
    if (size_ == 1) return incoming;
    {
      const WaitTimer timer(*this);
      exchange->run(incoming, dropped_.get(), failure);
    }
    agree_on_failure(*this, failure);
    std::sort(incoming.begin(), incoming.end(),
              [](const Message& a, const Message& b) { return a.rank < b.rank; });
    return incoming;
  }

  std::unique_ptr<SharedWriter> open_file(const std::string& path,
                                          const std::string& name) const override {
    std::unique_ptr<SharedWriter> file;
    collective_try(*this,
                   [&] { file = size_ == 1 ? open_alone(path, name) : open_by_mpi(path, name); });
    return file;
  }

 protected:
  Reduction reduce(const Reduction& mine) const override {
    require_mpi_runs();
    const WaitTimer timer(*this);
    Reduction all;
    check(MPI_Allreduce(&mine, &all, 1, reduction_, combining_, comm_), "MPI_Allreduce");
    return all;
  }
  void sum_entries(std::vector<std::int64_t>& values) const override {
    const WaitTimer timer(*this);
    check(MPI_Allreduce(MPI_IN_PLACE, values.data(), count(values.size()), MPI_INT64_T, MPI_SUM,
                        comm_),
          "MPI_Allreduce");
  }
  std::int64_t scan(std::int64_t value) const override {
    const auto mine = static_cast<std::uint64_t>(value);
    std::uint64_t before = 0;
    const WaitTimer timer(*this);
    check(MPI_Exscan(&mine, &before, 1, MPI_UINT64_T, MPI_SUM, comm_), "MPI_Exscan");
    // MPI leaves the result of rank 0 undefined.
    return rank_ == 0 ? 0 : static_cast<std::int64_t>(before);
  }
  void broadcast_bytes(char* bytes, std::size_t n, int root) const override {
    const WaitTimer timer(*this);
    check(MPI_Bcast(bytes, count(n), MPI_BYTE, root, comm_), "MPI_Bcast");
  }
  void allgather_sizes(std::uint64_t mine, std::vector<std::uint64_t>& all) const override {
    const WaitTimer timer(*this);
    check(MPI_Allgather(&mine, 1, MPI_UINT64_T, all.data(), 1, MPI_UINT64_T, comm_),
          "MPI_Allgather");
  }
  void allgather_bytes(const Bytes& mine, const std::vector<int>& sizes,
                       const std::vector<int>& offsets, Bytes& all) const override {
    const WaitTimer timer(*this);
    check(MPI_Allgatherv(mine.data(), count(mine.size()), MPI_BYTE, all.data(), sizes.data(),
                         offsets.data(), MPI_BYTE, comm_),
          "MPI_Allgatherv");
  }
  int message_length(std::uint64_t size) const override { return count(size); }

 private:
  // Each kind of message has its own tag, because messages that are received later must not be
  // mixed up with those in between.
  static constexpr int kSizeTag = 1, kDataTag = 2, kPersistentTag = 3, kSparseTag = 4;
  static constexpr int kTags = kSparseTag + MpiSparseExchange::kTags;

  class MpiPersistentExchange : public PersistentExchange {
   public:
    MpiPersistentExchange(const MpiCommunicator& comm, const std::vector<int>& neighbours,
                          const std::vector<Bytes>& outgoing, std::vector<Bytes>& incoming)
        : comm_(comm), neighbours_(neighbours), outgoing_(outgoing), incoming_(incoming) {
      messages_.reserve(pieces_of(outgoing) + pieces_of(incoming));
    }
    MpiPersistentExchange(const MpiPersistentExchange&) = delete;
    MpiPersistentExchange& operator=(const MpiPersistentExchange&) = delete;
    ~MpiPersistentExchange() override {
      if (messages_.none() || mpi_has_ended()) return;
      try {
        messages_.wait();
      } catch (...) {  // the values are discarded anyway
      }
    }

    void start() noexcept override {
      post(comm_.comm_, comm_.tag(kPersistentTag), neighbours_, outgoing_, incoming_, messages_);
    }
    void wait() override {
      require_mpi_runs();
      const WaitTimer timer(comm_);
      messages_.wait();
    }

   private:
    const MpiCommunicator& comm_;  // used by start() and wait() only
    const std::vector<int> neighbours_;
    const std::vector<Bytes>& outgoing_;
    std::vector<Bytes>& incoming_;
    MpiMessages messages_;
  };

  static std::size_t index(int rank) { return static_cast<std::size_t>(rank); }

  // Tags depend on the number of agreed failures. MPI guarantees tags up to 32767.
  int tag(int of_kind) const {
    constexpr std::uint32_t kCycle = 32768 / kTags;
    return static_cast<int>(agreed_failures() % kCycle) * kTags + of_kind;
  }

  // If a size does not arrive, wait() throws and the exchange ends here.
  void exchange_sizes(const std::vector<int>& neighbours,
                      const std::vector<Bytes>& outgoing) const {
    require_mpi_runs();
    const WaitTimer timer(*this);
    constexpr int kBytes = sizeof(std::uint64_t);
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
      sizes_out_[k] = outgoing[k].size();
      messages_.receive(&sizes_in_[k], kBytes, neighbours[k], tag(kSizeTag), comm_);
      messages_.send(&sizes_out_[k], kBytes, neighbours[k], tag(kSizeTag), comm_);
    }
    messages_.wait();
  }

  // The MPI reduction operation for Reduction.
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
  // Sizes of the messages from and to neighbours, and the messages that carry these sizes.
  mutable std::vector<std::uint64_t> sizes_in_, sizes_out_;
  mutable MpiMessages messages_;
  std::unique_ptr<char[]> dropped_ = std::make_unique<char[]>(kPiece);
};

// The ranks agree that all of them have allocated their memory before any of them waits in a
// collective call.
std::shared_ptr<Communicator> connected_to(MPI_Comm parent) {
  int ranks = 0;
  check(MPI_Comm_size(parent, &ranks), "MPI_Comm_size");
  std::shared_ptr<MpiCommunicator> made;
  std::exception_ptr failure;
  attempt(failure, [&] { made = std::make_shared<MpiCommunicator>(ranks); });
  const int mine = failure ? 1 : 0;
  int all = 0;
  check(MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MAX, parent), "MPI_Allreduce");
  if (failure) std::rethrow_exception(failure);
  if (all != 0) throw Error(ErrorKind::memory, "another rank: " + std::string(kOutOfMemory));
  made->connect(parent);
  return made;
}

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
  return connected_to(comm);
}

void require_our_mpi(const std::string& library) {
  // Version texts of Fortran are padded with blanks, and those of C may end with a newline.
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
