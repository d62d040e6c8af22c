// SPDX-License-Identifier: BSD-3-Clause
#include "tool/ranks.hpp"

#include <algorithm>
#include <climits>
#include <cstdlib>
#include <new>
#include <string_view>

#include "base/build_config.hpp"
#include "tool/exit.hpp"
#include "tool/library.hpp"

#if PNPBS_HAVE_MPI
#include <mpi.h>
#endif

namespace pnpbs::tool {
namespace {

// How this process was started, determined without MPI: initialising MPI takes a third of a second,
// which a run with one process need not spend.
struct Launch {
  bool by_mpi = false;
  int processes = 0;  // 0: unknown
};

// Variables with the number of processes: Open MPI's mpirun; PMI of the MPICH family, Slurm and
// others; MVAPICH's mpirun_rsh.
constexpr const char* size_variables[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE",
                                          "MV2_COMM_WORLD_SIZE"};

// Variables with the rank: PMIx (srun --mpi=pmix, prterun), and older and other PMI.
constexpr const char* rank_variables[] = {"PMIX_RANK", "PMI_RANK", "PALS_RANKID"};

// Evaluates the variables that launchers set for their processes. PNPBS_MPI=0 or 1 overrides them.
Launch launch_of_this_process() {
  Launch launch;
  for (const char* variable : size_variables) {
    const char* value = std::getenv(variable);
    if (value) launch = {true, std::max(launch.processes, std::atoi(value))};
  }
  for (const char* variable : rank_variables) launch.by_mpi |= std::getenv(variable) != nullptr;
  const char* request = std::getenv("PNPBS_MPI");
  if (request && std::string_view(request) == "0") return {};
  if (request && std::string_view(request) == "1") launch.by_mpi = true;
  return launch;
}

Failure described(std::exception_ptr failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const Failure& known) {
    return known;
  } catch (const std::bad_alloc&) {
    return {ExitCode::failed, "out of memory"};
  } catch (const std::exception& error) {
    return {ExitCode::failed, error.what()};
  }
}

}  // namespace

void Ranks::collective_try(const std::function<void()>& work) const {
  std::exception_ptr failure;
  try {
    work();
  } catch (...) {
    failure = std::current_exception();
  }
  if (size_ > 1) {
    agree_on_failure(failure);
  } else if (failure) {
    throw described(failure);
  }
}

std::string Ranks::from_first(const std::function<std::string()>& work) const {
  std::string text;
  collective_try([&] {
    if (is_first()) text = work();
  });
  if (size_ > 1) broadcast(text, 0);
  return text;
}

#if PNPBS_HAVE_MPI

Ranks::Ranks(int& argc, char**& argv) {
  const Launch launch = launch_of_this_process();
  launched_ = launch.by_mpi;
  if (!launched_) return;
  // Several threads compute, but only this one calls MPI.
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  if (launch.processes > 1 && size_ == 1) {
    MPI_Finalize();
    throw Failure(ExitCode::failed,
                  "started as one of " + std::to_string(launch.processes) +
                      " processes, but its MPI finds no other: it was built with " +
                      pnpbs_mpi_library() + ", whose own mpirun must start it");
  }
}

Ranks::~Ranks() {
  if (launched_) MPI_Finalize();
}

void Ranks::create_context(pnpbs_context* context) const {
  check(launched_ ? pnpbs_context_create_f(MPI_Comm_c2f(MPI_COMM_WORLD), context)
                  : pnpbs_context_create_serial(context),
        nullptr);
}

bool Ranks::any(bool mine) const {
  int found = mine;
  if (size_ > 1) MPI_Allreduce(MPI_IN_PLACE, &found, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return found != 0;
}

// Throws on all ranks the failure of the lowest rank that has one.
void Ranks::agree_on_failure(std::exception_ptr failure) const {
  int failed = failure ? rank_ : size_;
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  if (failed == size_) return;
  std::string message;
  int code = 0;
  if (rank_ == failed) {
    const Failure mine = described(failure);
    message = (is_first() ? "" : "rank " + std::to_string(rank_) + ": ") + mine.what();
    code = static_cast<int>(mine.code());
  }
  broadcast(message, failed);
  MPI_Bcast(&code, 1, MPI_INT, failed, MPI_COMM_WORLD);
  throw Failure(static_cast<ExitCode>(code), message);
}

void Ranks::broadcast(std::string& text, int root) const {
  int size = static_cast<int>(text.size());  // standard input is at most 1 GiB
  MPI_Bcast(&size, 1, MPI_INT, root, MPI_COMM_WORLD);
  text.resize(static_cast<std::size_t>(size));
  MPI_Bcast(text.data(), size, MPI_CHAR, root, MPI_COMM_WORLD);
}

std::vector<int> Ranks::gathered_counts(std::size_t mine) const {
  double total = static_cast<double>(mine);
  MPI_Allreduce(MPI_IN_PLACE, &total, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  if (total > INT_MAX) throw Failure(ExitCode::failed, "too many nodes or triangles for a picture");
  std::vector<int> counts(is_first() ? static_cast<std::size_t>(size_) : 0);
  const int count = static_cast<int>(mine);
  MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, MPI_COMM_WORLD);
  return counts;
}

void Ranks::allgather_bytes(const void* mine, std::size_t count, std::size_t size,
                            const std::vector<int>& counts, void* all) const {
  MPI_Datatype value;
  MPI_Type_contiguous(static_cast<int>(size), MPI_BYTE, &value);
  MPI_Type_commit(&value);
  std::vector<int> places;
  int place = 0;
  for (const int part : counts) {
    places.push_back(place);
    place += part;
  }
  MPI_Gatherv(mine, static_cast<int>(count), value, all, counts.data(), places.data(), value, 0,
              MPI_COMM_WORLD);
  MPI_Type_free(&value);
}

void Ranks::abort(int code) const {
  if (size_ > 1) MPI_Abort(MPI_COMM_WORLD, code);
  std::exit(code);
}

#else

Ranks::Ranks(int&, char**&) {
  const Launch launch = launch_of_this_process();
  if (launch.processes > 1) {
    throw Failure(ExitCode::failed, "started as one of " + std::to_string(launch.processes) +
                                        " processes, but built without MPI");
  }
}

Ranks::~Ranks() = default;

void Ranks::create_context(pnpbs_context* context) const {
  check(pnpbs_context_create_serial(context), nullptr);
}

bool Ranks::any(bool mine) const { return mine; }

// A build without MPI has one process.
void Ranks::agree_on_failure(std::exception_ptr) const {}
void Ranks::broadcast(std::string&, int) const {}
std::vector<int> Ranks::gathered_counts(std::size_t) const { return {}; }
void Ranks::allgather_bytes(const void*, std::size_t, std::size_t, const std::vector<int>&,
                            void*) const {}

void Ranks::abort(int code) const { std::exit(code); }

#endif

}  // namespace pnpbs::tool
