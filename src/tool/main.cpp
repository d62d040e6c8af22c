// SPDX-License-Identifier: BSD-3-Clause
// The command pnpbs: places nodes in a domain from a file and writes them to files. It uses the
// library through its C interface only, as any other program would.
#include <fcntl.h>
#include <unistd.h>

#include <iostream>

#include "tool/arguments.hpp"
#include "tool/domain.hpp"
#include "tool/exit.hpp"
#include "tool/interrupt.hpp"
#include "tool/library.hpp"
#include "tool/outputs.hpp"
#include "tool/progress.hpp"
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

// Initialises, warns, runs.
pnpbs_status place(pnpbs_context context, pnpbs_placement placement, bool quiet) {
  Progress progress(!quiet);
  progress.watch(placement);
  progress.say("laying the first nodes ...");
  check(pnpbs_placement_initialise(placement), context);
  progress.clear();
  if (!quiet) warn(warnings_of(context, placement));
  const pnpbs_status status = check(pnpbs_placement_run(placement), context);
  pnpbs_placement_set_monitor(placement, nullptr, nullptr);
  give_up_if_interrupted();
  return status;
}

ExitCode run(const Arguments& arguments) {
  Outputs outputs(arguments);
  const Spacing spacing(arguments);
  Context context;
  check(pnpbs_context_create_serial(context.out()), nullptr);
  for (const auto& [key, value] : arguments.options) {
    check(pnpbs_context_set(context, key.c_str(), value.c_str()), context);
  }
  Domain domain;
  check(pnpbs_domain_create(context, 2, domain.out()), context);
  read_domain(arguments.domain, domain, context);

  defer_interrupts();
  Placement placement;
  check(pnpbs_placement_create(context, domain, placement.out()), context);
  spacing.give_to(placement, context);
  const pnpbs_status status = place(context, placement, arguments.quiet);

  const Statistics statistics(placement);
  outputs.write(placement, domain, context);
  outputs.write_report(report_text(arguments, statistics, warnings_of(context, placement)));
  give_up_if_interrupted();
  outputs.publish();
  if (!arguments.quiet && !outputs.use_standard_output()) {
    std::cout << summary_text(statistics, outputs.files());
  }
  return status == PNPBS_NOT_CONVERGED ? ExitCode::not_converged : ExitCode::done;
}

ExitCode command(int argc, char** argv) {
  reserve_standard_streams();
  handle_interrupts();
  Arguments arguments;
  const ExitCode code = parse_arguments(argc, argv, arguments) ? run(arguments) : ExitCode::done;
  if (!std::cout.flush()) throw Failure(ExitCode::failed, "cannot write standard output");
  return code;
}

ExitCode fail(ExitCode code, const char* message) {
  std::cerr << "pnpbs: " << message << "\n";
  return code;
}

ExitCode guarded(int argc, char** argv) {
  try {
    return command(argc, argv);
  } catch (const Failure& failure) {
    return fail(failure.code(), failure.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::failed, "out of memory");
  } catch (const std::exception& error) {
    return fail(ExitCode::failed, error.what());
  }
}

}  // namespace
}  // namespace pnpbs::tool

int main(int argc, char** argv) { return static_cast<int>(pnpbs::tool::guarded(argc, argv)); }
