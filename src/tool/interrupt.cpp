// SPDX-License-Identifier: BSD-3-Clause
#include "tool/interrupt.hpp"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <string_view>

#include "io/temporaries.hpp"
#include "pnpbs/pnpbs.h"
#include "tool/exit.hpp"

namespace pnpbs::tool {
namespace {

std::atomic<bool> deferred{false};
std::atomic<bool> waited_for{false};
std::atomic<bool> asked{false};
std::atomic<bool> killed_soon{false};
std::atomic<bool> committing{false};
std::atomic<bool> callbacks_finish{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void remove_unfinished_files() {
  io::remove_temporaries();          // those of this program
  pnpbs_discard_unfinished_files();  // those of the library
}

// Calls only functions that are safe in a signal handler. Checkpoints may have been written before.
void say_interrupted() {
  const std::string_view text =
      waited_for ? "pnpbs: interrupted\n" : "pnpbs: interrupted, nothing was written\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

// The handler sets `asked` before it reads `committing`; begin_commit sets `committing` before it
// reads `asked`. So a signal either prevents the files from being renamed or leaves them alone.
extern "C" void on_signal(int number) {
  constexpr unsigned kPatience = 5;  // seconds
  const bool first = !asked.exchange(true);
  if (committing) return;
  if (deferred && first) {
    if (killed_soon) remove_unfinished_files();
    if (!waited_for) ::alarm(kPatience);
    return;
  }
  remove_unfinished_files();
  // the launcher signals all ranks; one message suffices
  if (number == SIGALRM || !killed_soon) say_interrupted();
  ::_exit(static_cast<int>(ExitCode::interrupted));
}

// A signal that the parent process ignores (nohup, background jobs) stays ignored.
void handle(int number) {
  struct sigaction action {};
  if (::sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) return;
  action = {};
  action.sa_handler = on_signal;
  ::sigaction(number, &action, nullptr);
}

}  // namespace

void handle_interrupts(bool launched) {
  killed_soon = launched;
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) handle(number);
  // A closed pipe or a limit on file sizes becomes an error of write, so that files are cleaned up.
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  for (const int number : {SIGPIPE, SIGXFSZ}) ::sigaction(number, &ignore, nullptr);
}

void defer_interrupts(bool until_saved) {
  waited_for = until_saved;
  deferred = true;
  handle(SIGALRM);
}

bool interrupted() { return asked; }

bool callbacks_give_up() { return asked && !callbacks_finish; }

void finish_callbacks() { callbacks_finish = true; }

bool begin_commit() {
  committing = true;
  return !asked;
}

void end_commit() { committing = false; }

void give_up_if_interrupted() {
  if (interrupted()) throw Interrupted();
}

}  // namespace pnpbs::tool
