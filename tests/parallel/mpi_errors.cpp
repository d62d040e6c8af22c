// SPDX-License-Identifier: BSD-3-Clause
// Makes a call of MPI fail on one rank, at many positions. Every rank must get PNPBS_ERROR_MPI, no
// rank may hang, and the next job on the same context must place the correct nodes. The functions
// below replace those of the MPI library (its profiling interface).
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace {

bool armed = false;                // on the rank whose calls are counted
std::map<std::string, long> made;  // number of calls by name
std::string failing;               // name of the call
long fails_at = 0;                 // number of the call that fails

// Returns whether this call fails. `kind` is the name of a call and the way in which it fails.
bool fails(const std::string& kind) { return armed && ++made[kind] == fails_at && kind == failing; }

}  // namespace

extern "C" {

int MPI_Isend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
              MPI_Request* request) {
  if (fails("MPI_Isend")) return MPI_ERR_OTHER;
  return PMPI_Isend(data, count, type, to, tag, comm, request);
}

int MPI_Issend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
               MPI_Request* request) {
  if (fails("MPI_Issend")) return MPI_ERR_OTHER;
  return PMPI_Issend(data, count, type, to, tag, comm, request);
}

// Fails in one of two ways. In the second one the message is received into another buffer.
int MPI_Irecv(void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm,
              MPI_Request* request) {
  static std::vector<char> elsewhere(1 << 20);
  if (fails("MPI_Irecv")) return MPI_ERR_OTHER;
  if (fails("MPI_Irecv that takes its message")) {
    PMPI_Irecv(elsewhere.data(), count, type, from, tag, comm, request);
    return MPI_ERR_OTHER;
  }
  return PMPI_Irecv(data, count, type, from, tag, comm, request);
}

int MPI_Recv(void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm,
             MPI_Status* status) {
  if (fails("MPI_Recv")) return MPI_ERR_OTHER;
  return PMPI_Recv(data, count, type, from, tag, comm, status);
}

int MPI_Waitall(int count, MPI_Request requests[], MPI_Status* statuses) {
  if (fails("MPI_Waitall")) return MPI_ERR_OTHER;
  return PMPI_Waitall(count, requests, statuses);
}

int MPI_Iprobe(int from, int tag, MPI_Comm comm, int* there, MPI_Status* status) {
  if (fails("MPI_Iprobe")) return MPI_ERR_OTHER;
  return PMPI_Iprobe(from, tag, comm, there, status);
}

int MPI_Testall(int count, MPI_Request requests[], int* done, MPI_Status* statuses) {
  if (fails("MPI_Testall")) return MPI_ERR_OTHER;
  return PMPI_Testall(count, requests, done, statuses);
}

int MPI_Test(MPI_Request* request, int* done, MPI_Status* status) {
  if (fails("MPI_Test")) return MPI_ERR_OTHER;
  return PMPI_Test(request, done, status);
}

int MPI_Ibarrier(MPI_Comm comm, MPI_Request* request) {
  if (fails("MPI_Ibarrier")) return MPI_ERR_OTHER;
  return PMPI_Ibarrier(comm, request);
}

// Fails only in reductions by which ranks agree on an error, not in sums of many entries.
int MPI_Allreduce(const void* in, void* out, int count, MPI_Datatype type, MPI_Op op,
                  MPI_Comm comm) {
  if (op != MPI_SUM && fails("MPI_Allreduce")) return MPI_ERR_OTHER;
  return PMPI_Allreduce(in, out, count, type, op, comm);
}

}  // extern "C"

namespace {

pnpbs_context context;
int rank, size, failures;

void expect(bool condition, const std::string& what) {
  if (condition) return;
  std::fprintf(stderr, "rank %d of %d: %s; last error: %s\n", rank, size, what.c_str(),
               pnpbs_last_error(context));
  ++failures;
}

std::int32_t spacing(std::int64_t n, std::int32_t dim, const double* x, double* d, void*) {
  for (std::int64_t i = 0; i < n; ++i) d[i] = (dim == 2 ? 0.04 : 0.2) * (1 + x[dim * i]);
  return 0;
}

pnpbs_placement new_placement(int dim) {
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1}, low[] = {0, 0, 0}, high[] = {1, 1, 1};
  pnpbs_domain domain;
  pnpbs_placement placement;
  pnpbs_domain_create(context, dim, &domain);
  if (dim == 2)
    pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square, nullptr, 0);
  else
    pnpbs_domain_add_box(domain, low, high, 1);
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  pnpbs_domain_destroy(&domain);
  // A run has few steps, but all kinds of events, and several exchanges between two events.
  pnpbs_placement_set_int64(placement, "steps", 12);
  pnpbs_placement_set_int64(placement, "event_interval", 6);
  pnpbs_placement_set_int64(placement, "exchange_interval", 1);
  pnpbs_placement_set_int64(placement, "sweeps", 2);
  pnpbs_placement_set_spacing_callback(placement, spacing, nullptr);
  return placement;
}

// Places nodes, and exchanges values between nodes and ghosts, until the first error.
pnpbs_status job(pnpbs_placement placement) {
  pnpbs_status status = pnpbs_placement_run(placement);
  std::int64_t nodes = 0, ghosts = 0;
  if (status >= 0) status = pnpbs_placement_count(placement, &nodes);
  if (status >= 0) status = pnpbs_placement_ghost_count(placement, &ghosts);
  if (status < 0) return status;
  const auto all = static_cast<std::size_t>(nodes + ghosts);
  std::vector<double> values(all, 7);
  std::fill(values.begin() + nodes, values.end(), -1);
  status = pnpbs_placement_update_ghosts(placement, nodes + ghosts, 1, values.data());
  if (status < 0) return status;
  for (const double value : values) expect(value == 7, "a value that has come");
  return pnpbs_placement_add_from_ghosts(placement, nodes + ghosts, 1, values.data());
}

std::string hash_of(pnpbs_placement placement) {
  const char* hash = "";
  expect(pnpbs_placement_get_string(placement, "hash", &hash) == PNPBS_OK, "hash");
  return hash;
}

void expect_same_status(pnpbs_status status, const std::string& what) {
  int mine = status, all[2], both[2] = {mine, -mine};
  PMPI_Allreduce(both, all, 2, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  expect(all[0] == -all[1], what + ": ranks disagree on the status");
}

// Performs the job with one failing call. Returns whether the call was reached.
bool check_failure(int dim, int bad, const std::string& kind, long at, const std::string& right) {
  const std::string what =
      kind + " number " + std::to_string(at) + " fails on rank " + std::to_string(bad);
  pnpbs_placement placement = new_placement(dim);
  failing = kind;
  fails_at = at;
  made.clear();
  armed = rank == bad;
  const pnpbs_status status = job(placement);
  armed = false;
  int reached = made[kind] >= at;
  PMPI_Bcast(&reached, 1, MPI_INT, bad, MPI_COMM_WORLD);
  expect_same_status(status, what);
  expect(reached != 0 ? status == PNPBS_ERROR_MPI : status >= 0, what + ": status");
  expect(job(placement) >= 0, what + ": the same placement afterwards");
  pnpbs_placement_destroy(&placement);
  if (!reached) return false;
  placement = new_placement(dim);
  expect(job(placement) >= 0, what + ": another placement afterwards");
  expect(hash_of(placement) == right, what + ": other nodes");
  pnpbs_placement_destroy(&placement);
  return true;
}

// Checks an update that each rank ends locally, if one of its messages cannot be sent. Its sender
// and its receiver must get the error, and the next update must be correct.
void check_split_update(int bad) {
  pnpbs_placement placement = new_placement(2);
  std::int64_t nodes = 0, ghosts = 0;
  expect(job(placement) >= 0, "a job before updates");
  pnpbs_placement_count(placement, &nodes);
  pnpbs_placement_ghost_count(placement, &ghosts);
  std::vector<double> values(static_cast<std::size_t>(nodes + ghosts), 7);
  const auto end_update = [&] {
    return pnpbs_placement_end_update_ghosts(placement, nodes + ghosts, 1, values.data());
  };
  failing = "MPI_Isend";
  fails_at = 1;
  made.clear();
  armed = rank == bad;
  expect(
      pnpbs_placement_begin_update_ghosts(placement, nodes + ghosts, 1, values.data()) == PNPBS_OK,
      "an update begins");
  armed = false;
  const int failed = end_update() == PNPBS_ERROR_MPI ? 1 : 0;
  int all = 0;
  PMPI_Allreduce(&failed, &all, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  expect(all == 2, "an update that fails on two ranks");
  expect(rank != bad || failed == 1, "an update that fails where it was not sent");
  expect(end_update() == PNPBS_ERROR_STATE, "an update that has ended");
  std::fill(values.begin() + nodes, values.end(), -1);
  expect(pnpbs_placement_update_ghosts(placement, nodes + ghosts, 1, values.data()) == PNPBS_OK,
         "the next update");
  for (const double value : values) expect(value == 7, "a value of the next update");
  pnpbs_placement_destroy(&placement);
}

void check_failures(int dim, int bad) {
  pnpbs_placement placement = new_placement(dim);
  made.clear();
  fails_at = 0;
  armed = true;
  expect(job(placement) >= 0, "a job without failures");
  armed = false;
  const std::string right = hash_of(placement);
  pnpbs_placement_destroy(&placement);
  std::map<std::string, long> calls = made;
  for (const char* kind :
       {"MPI_Isend", "MPI_Irecv", "MPI_Irecv that takes its message", "MPI_Waitall", "MPI_Issend",
        "MPI_Recv", "MPI_Iprobe", "MPI_Testall", "MPI_Test", "MPI_Ibarrier", "MPI_Allreduce"}) {
    PMPI_Bcast(&calls[kind], 1, MPI_LONG, bad, MPI_COMM_WORLD);
    expect(calls[kind] > 3, std::string(kind) + ": calls to fail in");
    const long stride = std::max(1L, calls[kind] / 7);
    long reached = 0;
    for (long at = 1; at <= calls[kind]; at += stride)
      reached += check_failure(dim, bad, kind, at, right) ? 1 : 0;
    expect(reached > 0, std::string(kind) + ": failures");
  }
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  expect(pnpbs_context_create_mpi(MPI_COMM_WORLD, &context) == PNPBS_OK, "context");
  check_split_update(size - 1);
  check_failures(2, 1);
  check_failures(3, 0);
  pnpbs_context_destroy(&context);
  int all = 0;
  PMPI_Allreduce(&failures, &all, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  if (rank == 0) std::printf("%d failed\n", all);
  MPI_Finalize();
  return all != 0;
}
