// SPDX-License-Identifier: BSD-3-Clause
#include "base/kokkos_runtime.hpp"

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <mutex>

#include "base/error.hpp"
#include "base/execution.hpp"
#include "base/small_letters.hpp"

extern char** environ;

namespace pnpbs {

namespace {

std::mutex starting;
bool started_here = false;
std::atomic<int> running_threads{0};      // of Kokkos, set when this library starts or adopts it
std::atomic<int> threads_before_fork{0};  // set in a forked process if there were several

int cores_we_may_use() {
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) == 0) return std::max(1, CPU_COUNT(&set));
  return 1;
}

bool positive_integer(const std::string& text, int& value) {
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  return result.ec == std::errc() && result.ptr == text.data() + text.size() && value > 0;
}

// Throws for KOKKOS_* variables with values that make Kokkos end the process when it starts.
void check_environment() {
  const char* known_flags[] = {"KOKKOS_DISABLE_WARNINGS", "KOKKOS_PRINT_CONFIGURATION",
                               "KOKKOS_TUNE_INTERNALS"};
  const char* known_numbers[] = {"KOKKOS_NUM_THREADS", "KOKKOS_DEVICE_ID", "KOKKOS_NUM_DEVICES"};
  const char* known_choices[] = {"random", "mpi_rank"};  // values of KOKKOS_MAP_DEVICE_ID_BY
  for (char** entry = environ; entry && *entry; ++entry) {
    const std::string text = *entry;
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals), value = text.substr(equals + 1);
    if (name == "KOKKOS_MAP_DEVICE_ID_BY" &&
        std::find(std::begin(known_choices), std::end(known_choices), value) ==
            std::end(known_choices))
      throw Error(ErrorKind::kokkos,
                  "the environment variable " + name + " is \"" + value +
                      "\"; Kokkos accepts random or mpi_rank: unset or correct it");
    for (const char* number : known_numbers) {
      int parsed = 0;
      if (name == number && !positive_integer(value, parsed) &&
          !(name != known_numbers[0] && value == "0"))
        throw Error(
            ErrorKind::kokkos,
            "the environment variable " + name + " is \"" + value + "\"; Kokkos accepts " +
                (name == known_numbers[0] ? "a positive integer" : "an integer of 0 or more") +
                ": unset or correct it");
    }
    for (const char* flag : known_flags) {
      const std::string allowed[] = {"0", "1", "true", "false", "yes", "no", "on", "off"};
      const std::string small = to_lower_case(value);
      if (name == flag &&
          std::find(std::begin(allowed), std::end(allowed), small) == std::end(allowed))
        throw Error(ErrorKind::kokkos, "the environment variable " + name + " is \"" + value +
                                           "\"; Kokkos accepts true or false: unset or correct it");
    }
  }
}

// Registers `before_end` with Kokkos, once per process. All Views must be released before Kokkos
// ends.
void watch_end(void (*before_end)()) {
  static bool watching = false;
  if (watching) return;
  Kokkos::push_finalize_hook(before_end);
  watching = true;
}

void note_fork() {
  if (running_threads > 1) threads_before_fork = running_threads.load();
}

// Records the number of threads and installs the handler of forks. Called when Kokkos runs.
void watch_forks() {
  static const int watching = pthread_atfork(nullptr, nullptr, note_fork);
  if (watching != 0) throw std::bad_alloc();
  running_threads = Exec().concurrency();
}

int threads_of_environment() {
  for (const char* name : {"OMP_NUM_THREADS", "KOKKOS_NUM_THREADS"}) {
    const char* value = std::getenv(name);
    int threads = 0;
    // OMP_NUM_THREADS may list one number for each nesting level. The first one applies here.
    if (value && positive_integer(std::string(value, std::strcspn(value, ",")), threads))
      return threads;
  }
  return 0;
}

}  // namespace

void start_kokkos(std::int64_t threads, int ranks_on_node, void (*before_end)()) {
  require_threads();
  const std::lock_guard<std::mutex> lock(starting);
  if (Kokkos::is_initialized()) {
    watch_end(before_end);
    watch_forks();
    return;
  }
  if (Kokkos::is_finalized())
    throw Error(ErrorKind::kokkos,
                "Kokkos has been finalised in this process and cannot start again");
  check_environment();
  int count = static_cast<int>(threads);
  if (count == 0) count = threads_of_environment();
  if (count == 0) count = std::max(1, cores_we_may_use() / std::max(1, ranks_on_node));
  Kokkos::InitializationSettings settings;
  settings.set_num_threads(count);
  settings.set_disable_warnings(true);  // otherwise Kokkos prints a remark about OMP_PROC_BIND
  try {
    Kokkos::initialize(settings);
  } catch (const std::exception& failure) {
    throw Error(ErrorKind::kokkos, std::string("Kokkos did not start: ") + failure.what());
  }
  started_here = true;
  watch_end(before_end);
  watch_forks();
}

void require_threads() {
  const int threads = threads_before_fork.load(std::memory_order_relaxed);
  if (threads == 0) return;
  throw Error(ErrorKind::state,
              "this process was forked from one in which Kokkos had started " +
                  std::to_string(threads) +
                  " threads, and does not have them: fork before the first placement is created, "
                  "start the process by exec, or set threads = 1 before");
}

void require_kokkos() {
  require_threads();
  if (Kokkos::is_initialized()) return;
  throw Error(ErrorKind::kokkos, Kokkos::is_finalized()
                                     ? "Kokkos has been finalised in this process: nothing can be "
                                       "computed any more"
                                     : "Kokkos is not initialised");
}

bool kokkos_was_started() { return Kokkos::is_initialized() || Kokkos::is_finalized(); }

void end_kokkos() {
  require_threads();
  const std::lock_guard<std::mutex> lock(starting);
  if (started_here && Kokkos::is_initialized()) Kokkos::finalize();
}

std::int64_t thread_count() {
  return Kokkos::is_initialized() ? static_cast<std::int64_t>(Exec().concurrency()) : 0;
}

}  // namespace pnpbs
