// SPDX-License-Identifier: BSD-3-Clause
// Tests that lack of memory on one rank, at every large allocation, is reported on every rank. No
// rank hangs, the failed call leaves the placement unchanged, and a later run on the same context
// places the correct nodes. The operators new below reject one large request, or all requests from
// one on.
// usage: memory [STRIDE [LEAST]]
//   STRIDE  every STRIDE-th request is rejected in a run of its own
//   LEAST   smallest size of the requests that count, in bytes
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>

#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>
#include <vector>

#include "placement_view.hpp"

namespace {

constexpr std::size_t kLarge = 1024;  // bytes
std::size_t least_refused = kLarge;   // bytes
std::atomic<long> until_refusal{-1};  // number of large requests; negative: none is rejected
std::atomic<bool> refuse_all_after{false};
std::atomic<long> asked{0}, refusals{0};

bool refused(std::size_t size) {
  if (size < least_refused) return false;
  ++asked;
  if (until_refusal < 0) return false;
  const long left = until_refusal--;
  if (left > 0) return false;
  if (refuse_all_after) until_refusal = 0;
  ++refusals;
  return true;
}

void* allocate(std::size_t size, std::size_t alignment) {
  if (refused(size)) return nullptr;
  const std::size_t whole = (size + alignment - 1) / alignment * alignment;
  return std::aligned_alloc(alignment, whole > 0 ? whole : alignment);
}

void* allocate_or_throw(std::size_t size, std::size_t alignment) {
  void* memory = allocate(size, alignment);
  if (!memory) throw std::bad_alloc();
  return memory;
}

constexpr std::size_t kUsual = __STDCPP_DEFAULT_NEW_ALIGNMENT__;

}  // namespace

void* operator new(std::size_t size) { return allocate_or_throw(size, kUsual); }
void* operator new[](std::size_t size) { return allocate_or_throw(size, kUsual); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return allocate(size, kUsual);
}
void* operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t, const std::nothrow_t&) noexcept {
  std::free(memory);
}

namespace {

pnpbs_context context;
int rank, size, failures;

void expect(bool condition, const std::string& what) {
  if (condition) return;
  std::fprintf(stderr, "rank %d: %s; last error: %s\n", rank, what.c_str(),
               pnpbs_last_error(context));
  ++failures;
}

std::int32_t spacing(std::int64_t n, std::int32_t dim, const double* x, double* d, void*) {
  for (std::int64_t i = 0; i < n; ++i)
    d[i] = 0.025 + 0.06 * std::hypot(x[dim * i] - 0.4, x[dim * i + 1] - 0.5);
  return 0;
}

pnpbs_placement new_placement() {
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1};
  pnpbs_domain domain;
  pnpbs_placement placement;
  pnpbs_domain_create(context, 2, &domain);
  pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square, nullptr, 0);
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  pnpbs_domain_destroy(&domain);
  // A run has few steps but all kinds of events.
  pnpbs_placement_set_int64(placement, "steps", 8);
  pnpbs_placement_set_int64(placement, "event_interval", 4);
  pnpbs_placement_set_int64(placement, "exchange_interval", 2);
  pnpbs_placement_set_int64(placement, "sweeps", 2);
  pnpbs_placement_set_spacing_callback(placement, spacing, nullptr);
  return placement;
}

constexpr const char* kFile = "memory_on_ranks.vtu";

// Returns the results of queries. Requests of the test itself are not rejected.
PlacementView view_of(pnpbs_placement placement,
                      PlacementView (*view)(pnpbs_placement) = view_before_call) {
  const long refuse = until_refusal.exchange(-1);
  PlacementView seen = view(placement);
  until_refusal = refuse;
  return seen;
}

// Performs all collective operations until the first error. `before` receives the results of
// queries before the failing call.
pnpbs_status whole_job(pnpbs_placement placement, PlacementView& before) {
  before = view_of(placement);
  pnpbs_status status = pnpbs_placement_run(placement);
  if (status < 0) return status;
  std::int64_t nodes = 0, ghosts = 0, triangles = 0;
  pnpbs_placement_count(placement, &nodes);
  const long refuse = until_refusal.exchange(-1);  // allocations of the test are not rejected
  std::vector<double> d(static_cast<std::size_t>(nodes) + 1);
  until_refusal = refuse;
  status = pnpbs_placement_get_nodes(placement, nodes, nullptr, nullptr, nullptr, d.data());
  if (status == PNPBS_ERROR_MEMORY) {  // a local call: other ranks do not get the error
    until_refusal = -1;
    status = pnpbs_placement_get_nodes(placement, nodes, nullptr, nullptr, nullptr, d.data());
  }
  expect(status == PNPBS_OK, "get_nodes");
  for (double& value : d) value = 0.9 * value + 0.001;
  before = {};  // these calls build lists, which changes statistics
  status = pnpbs_placement_ghost_count(placement, &ghosts);
  if (status < 0) return status;
  status = pnpbs_placement_get_triangles(placement, 0, &triangles, nullptr);
  if (status < 0) return status;
  status = pnpbs_placement_exchange_sizes(placement, nullptr, nullptr, nullptr);
  if (status < 0) return status;
  before = view_of(placement);
  status = pnpbs_placement_set_spacing_at_nodes(placement, nodes, d.data());
  if (status < 0) return status;
  const char *const paths[] = {"/dev/null", kFile}, *const formats[] = {"csv", "vtu"};
  const std::int32_t elements[] = {0, 1};
  status = pnpbs_placement_write_files(placement, 2, paths, formats, elements);
  if (status < 0) return status;
  return pnpbs_placement_run(placement);
}

std::string hash_of(pnpbs_placement placement) {
  const char* hash = "";
  expect(pnpbs_placement_get_string(placement, "hash", &hash) == PNPBS_OK, "hash");
  return hash;
}

// Rejects the n-th large request of one rank. Returns whether there was one.
bool fails_well(int on_rank, long n, bool all_after, const std::string& right_hash) {
  const std::string name = "request " + std::to_string(n) + " on rank " + std::to_string(on_rank);
  pnpbs_placement placement = new_placement();
  refusals = 0;
  refuse_all_after = all_after;
  until_refusal = rank == on_rank ? n : -1;
  PlacementView before;
  const pnpbs_status status = whole_job(placement, before);
  until_refusal = -1;
  long happened = refusals;
  MPI_Bcast(&happened, 1, MPI_LONG, on_rank, MPI_COMM_WORLD);
  int mine = status, min, max;
  MPI_Allreduce(&mine, &min, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  MPI_Allreduce(&mine, &max, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  expect(min == max, name + ": ranks disagree on the status");
  if (status < 0) {
    expect(status == PNPBS_ERROR_MEMORY, name + ": another status");
    const std::string wanted = size > 1 ? "rank " + std::to_string(on_rank) + ": " : "out of";
    // A rank without any memory has no message.
    const bool has_text = !all_after || least_refused == kLarge || rank != on_rank;
    expect(!has_text || std::strncmp(pnpbs_last_error(context), wanted.c_str(), wanted.size()) == 0,
           name + ": another message");
    const PlacementView after = view_of(placement, view_after_call);
    expect(before == PlacementView{} || before == after,
           name + ": changed " + before.difference(after));
    // The placement can be run again after the error.
    expect(pnpbs_placement_run(placement) >= 0, name + ": run again");
  } else {
    expect(hash_of(placement) == right_hash, name + ": not told, and other nodes");
  }
  pnpbs_placement_destroy(&placement);
  if (n % 4 == 0) {
    placement = new_placement();
    expect(whole_job(placement, before) >= 0 && hash_of(placement) == right_hash,
           name + ": other nodes in a later run on the context");
    pnpbs_placement_destroy(&placement);
  }
  return happened > 0;
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  const long stride = argc > 1 ? std::atol(argv[1]) : 1;
  if (argc > 2) least_refused = static_cast<std::size_t>(std::atol(argv[2]));
  expect(pnpbs_context_create_mpi(MPI_COMM_WORLD, &context) == PNPBS_OK, "context");
  pnpbs_placement placement = new_placement();
  asked = 0;
  PlacementView before;
  expect(whole_job(placement, before) >= 0, "undisturbed");
  long requests = asked;
  MPI_Allreduce(MPI_IN_PLACE, &requests, 1, MPI_LONG, MPI_MIN, MPI_COMM_WORLD);
  const std::string right_hash = hash_of(placement);
  pnpbs_placement_destroy(&placement);
  expect(requests > 100, "large requests to refuse");
  long refused_ones = 0;
  for (long n = 0; n < requests; n += stride)
    refused_ones +=
        fails_well(static_cast<int>(n / stride) % size, n, n / stride % 2 == 1, right_hash);
  expect(refused_ones * stride > requests / 2, "requests were refused");
  pnpbs_context_destroy(&context);
  if (rank == 0) std::remove(kFile);
  int all;
  MPI_Allreduce(&failures, &all, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  if (rank == 0)
    std::printf("%d failed; %ld of %ld requests refused\n", all, refused_ones, requests);
  MPI_Finalize();
  return all != 0;
}
