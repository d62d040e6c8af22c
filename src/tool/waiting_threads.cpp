// SPDX-License-Identifier: BSD-3-Clause
#include "tool/waiting_threads.hpp"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace pnpbs::tool {
namespace {

// Variables with the number of processes of the job on this machine: Open MPI, MPICH and its
// derivatives, MVAPICH.
constexpr const char* ranks_here[] = {"OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS",
                                      "MV2_COMM_WORLD_LOCAL_SIZE"};
// Some microseconds, in which most waits on an idle machine end. GCC's default of 300 000 is about
// a millisecond.
constexpr const char* spins_before_sleep = "1000";
constexpr const char* threads_of_one[] = {"OMP_NUM_THREADS", "KOKKOS_NUM_THREADS"};

template <std::size_t N>
int first_number(const char* const (&variables)[N]) {
  for (const char* variable : variables)
    if (const char* value = std::getenv(variable)) return std::atoi(value);
  return 0;
}

int threads_asked_for(char** argv) {
  for (char** argument = argv; *argument; ++argument) {
    if (std::strcmp(*argument, "--threads") == 0 && argument[1]) return std::atoi(argument[1]);
    if (std::strncmp(*argument, "--threads=", 10) == 0) return std::atoi(*argument + 10);
  }
  return first_number(threads_of_one);
}

int cores() {
  cpu_set_t set;
  return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

}  // namespace

// If no number of threads is given, the ranks on this machine share its cores.
void set_wait_policy(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT")) return;
  const int ranks = std::max(1, first_number(ranks_here)), asked_for = threads_asked_for(argv),
            threads = asked_for > 0 ? asked_for : cores() / ranks;
  if (threads < 2) return;
  if (threads * ranks > cores())
    setenv("OMP_WAIT_POLICY", "passive", 0);
  else
    setenv("GOMP_SPINCOUNT", spins_before_sleep, 0);
  // Uses the path of the executable, which process lists show. execv returns only on failure; the
  // threads then keep spinning.
  char name[4096];
  const ssize_t length = readlink("/proc/self/exe", name, sizeof name - 1);
  if (length <= 0) return;
  name[length] = 0;
  execv(name, argv);
}

}  // namespace pnpbs::tool
