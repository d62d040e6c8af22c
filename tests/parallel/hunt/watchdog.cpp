// SPDX-License-Identifier: BSD-3-Clause
// Reports the running case on standard error by an alarm signal.

#include "watchdog.hpp"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>

namespace hunt {

namespace {

constexpr unsigned kSeconds = 60;

// The signal handler reads these buffers, so they are arrays of fixed size.
char job_text[200], what_text[200];

void put(const char* text) {
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) return;
}

void tell(int) {
  put("hunt: case ");
  put(job_text);
  put(" has not ended: ");
  put(what_text);
  put("\n");
  alarm(kSeconds);
}

void copy(const std::string& text, char (&to)[200]) {
  const std::size_t size = std::min(text.size(), sizeof to - 1);
  std::memcpy(to, text.data(), size);
  to[size] = 0;
}

}  // namespace

void watch(const std::string& job, const std::string& what) {
  alarm(0);
  if (!job.empty()) copy(job, job_text);
  copy(what, what_text);
  struct sigaction action {};
  action.sa_handler = tell;
  action.sa_flags = SA_RESTART;
  sigaction(SIGALRM, &action, nullptr);
  alarm(kSeconds);
}

void end_watch() { alarm(0); }

}  // namespace hunt
