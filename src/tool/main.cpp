// SPDX-License-Identifier: BSD-3-Clause
// The command pnpbs: places nodes in a domain from a file and writes them to files. It uses the
// library through its C interface only, as any other program would.
#include <fcntl.h>
#include <unistd.h>

#include <iostream>
#include <optional>

#include "tool/arguments.hpp"
#include "tool/domain.hpp"
#include "tool/exit.hpp"
#include "tool/interrupt.hpp"
#include "tool/library.hpp"
#include "tool/outputs.hpp"
#include "tool/progress.hpp"
#include "tool/ranks.hpp"
#include "tool/report.hpp"
#include "tool/spacing.hpp"
#include "tool/statistics.hpp"
#include "tool/summary.hpp"

namespace pnpbs::tool {
namespace {

// Otherwise the first file opened could become "standard output".
void reserve_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // Opened the wrong way round, so that using it is still an error.
    if (::fcntl(descriptor, F_GETFD) < 0) {
      ::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    }
  }
}

void warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) std::cerr << "pnpbs: warning: " << warning << "\n";
}

void give_up_if_any_is_interrupted(const Ranks& ranks) {
  if (ranks.any(interrupted())) throw Interrupted();
}

// Initialises, warns, runs.
pnpbs_status place(pnpbs_context context, pnpbs_placement placement, const Arguments& arguments,
                   const Ranks& ranks) {
  const bool talk = ranks.is_first() && !arguments.quiet;
  Progress progress(talk, arguments.progress);
  progress.watch(placement);
  progress.say("laying the first nodes ...");
  check(pnpbs_placement_initialise(placement), context);
  progress.clear();
  if (talk) warn(warnings_of(context, placement));
  const pnpbs_status status = check(pnpbs_placement_run(placement), context);
  pnpbs_placement_set_monitor(placement, nullptr, nullptr);
  give_up_if_any_is_interrupted(ranks);
  return status;
}

ExitCode run(const Arguments& arguments, const Ranks& ranks) {
  std::optional<Outputs> outputs;
  std::optional<Spacing> spacing;
  ranks.agreed([&] {
    outputs.emplace(arguments, ranks);
    spacing.emplace(arguments);
  });
  Context context;
  ranks.create_context(context.out());
  Domain domain;
  ranks.agreed([&] {
    for (const auto& [key, value] : arguments.options) {
      check(pnpbs_context_set(context, key.c_str(), value.c_str()), context);
    }
    check(pnpbs_domain_create(context, 2, domain.out()), context);
  });
  read_domain(arguments.domain, domain, context, ranks);

  defer_interrupts();
  Placement placement;
  check(pnpbs_placement_create(context, domain, placement.out()), context);
  spacing->give_to(placement, context);
  const pnpbs_status status = place(context, placement, arguments, ranks);

  const Statistics statistics(placement);
  outputs->write_pictures(placement, domain, context);
  outputs->write_report(report_text(arguments, statistics, warnings_of(context, placement)));
  give_up_if_any_is_interrupted(ranks);
  outputs->write_nodes(placement, context);
  if (ranks.is_first() && !arguments.quiet && !outputs->use_standard_output()) {
    std::cout << summary_text(statistics, outputs->files());
  }
  return status == PNPBS_NOT_CONVERGED ? ExitCode::not_converged : ExitCode::done;
}

ExitCode command(int argc, char** argv, const Ranks& ranks) {
  Arguments arguments;
  std::string answer;
  ranks.agreed([&] { answer = parse_arguments(argc, argv, arguments); });
  const ExitCode code = answer.empty() ? run(arguments, ranks) : ExitCode::done;
  ranks.agreed([&] {
    if (ranks.is_first() && !(std::cout << answer).flush())
      throw Failure(ExitCode::failed, "cannot write standard output");
  });
  return code;
}

ExitCode fail(ExitCode code, const std::string& message) {
  std::cerr << "pnpbs: " + message + "\n";  // in one piece, lest ranks mix their words
  return code;
}

// A Failure is all ranks', at the same place: see Ranks. If a signal has come to one of them, our
// callbacks have failed for that reason.
ExitCode end_together(const Failure& failure, const Ranks& ranks) {
  const bool stopped = ranks.any(interrupted());
  const Failure reason = stopped ? Interrupted() : failure;
  return ranks.is_first() ? fail(reason.code(), reason.what()) : reason.code();
}

ExitCode guarded(int argc, char** argv, const Ranks& ranks) {
  try {
    return command(argc, argv, ranks);
  } catch (const Failure& failure) {
    return end_together(failure, ranks);
  } catch (const std::bad_alloc&) {
    ranks.abort(static_cast<int>(fail(ExitCode::failed, "out of memory")));
  } catch (const std::exception& error) {
    ranks.abort(static_cast<int>(fail(ExitCode::failed, error.what())));
  }
}

ExitCode start(int argc, char** argv) {
  reserve_standard_streams();
  try {
    const Ranks ranks(argc, argv);
    handle_interrupts(ranks.launched());
    return guarded(argc, argv, ranks);
  } catch (const Failure& failure) {
    return fail(failure.code(), failure.what());
  }
}

}  // namespace
}  // namespace pnpbs::tool

int main(int argc, char** argv) { return static_cast<int>(pnpbs::tool::start(argc, argv)); }
