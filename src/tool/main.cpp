// SPDX-License-Identifier: BSD-3-Clause
// The command pnpbs, which places nodes in a domain from a file and writes them to files. It uses
// the library through the C interface only, as any other program would.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <functional>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "tool/argument_rules.hpp"
#include "tool/arguments.hpp"
#include "tool/centred_nodes.hpp"
#include "tool/checkpoints.hpp"
#include "tool/density.hpp"
#include "tool/domain.hpp"
#include "tool/exit.hpp"
#include "tool/file_format.hpp"
#include "tool/interrupt.hpp"
#include "tool/library.hpp"
#include "tool/named_grids.hpp"
#include "tool/node_fields.hpp"
#include "tool/numbers.hpp"
#include "tool/open_boundary.hpp"
#include "tool/outputs.hpp"
#include "tool/particles.hpp"
#include "tool/progress.hpp"
#include "tool/ranks.hpp"
#include "tool/report.hpp"
#include "tool/spacing.hpp"
#include "tool/statistics.hpp"
#include "tool/summary.hpp"
#include "tool/waiting_threads.hpp"

namespace pnpbs::tool {
namespace {

// The parsed arguments before the domain exists. They are built first, so that errors of the user
// appear before any work is done.
struct Requests {
  std::optional<Outputs> outputs;
  std::optional<DomainSource> source;
  std::optional<NamedGrids> grids;
  std::optional<Spacing> spacing;
  std::optional<Density> density;
  std::optional<NodeFields> fields;
  std::optional<OpenBoundary> open_boundary;
  Requests(const Arguments& arguments, const Ranks& ranks) {
    ranks.collective_try([&] {
      if (!arguments.dry_run) outputs.emplace(arguments, ranks);
      source.emplace(arguments);
      refuse_other_dimension(arguments, source->dimension());
      grids.emplace(arguments, source->dimension());
      spacing.emplace(arguments, source->dimension(), *grids);
      if (arguments.density) density.emplace(*arguments.density, source->dimension());
      fields.emplace(arguments, source->dimension(), *grids);
      if (!arguments.open_boundary.empty())
        open_boundary.emplace(arguments.open_boundary, source->dimension(), *grids);
      require_use_of_grids();
    });
  }

  Requests(const Requests&) = delete;  // formulas refer to the grids
  Requests& operator=(const Requests&) = delete;

 private:
  void require_use_of_grids() const {
    std::vector<std::string> formulas = fields->formulas();
    formulas.insert(formulas.begin(), spacing->formula());
    if (open_boundary) formulas.push_back(open_boundary->formula());
    grids->require_use_in(formulas);
  }
};

// Opens missing standard streams. Otherwise the first file opened could become "standard output".
void reserve_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // The access mode is the wrong one on purpose, so that using the stream is still an error.
    if (::fcntl(descriptor, F_GETFD) < 0) {
      ::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    }
  }
}

// Writes the warnings from index `first` on.
void warn(const std::vector<std::string>& warnings, std::size_t first = 0) {
  for (std::size_t k = first; k < warnings.size(); ++k)
    std::cerr << "pnpbs: warning: " << warnings[k] << "\n";
}

ExitCode exit_code_of_run(pnpbs_status status) {
  switch (status) {
    case PNPBS_NOT_CONVERGED:
      return ExitCode::not_converged;
    case PNPBS_SPACING_MISSED:
      return ExitCode::spacing_missed;
    case PNPBS_NOT_CONFORMING:
      return ExitCode::not_conforming;
    default:
      return ExitCode::done;
  }
}

bool is_about_elements(const Warning& warning) {
  return warning.code == PNPBS_WARNING_BOUNDARY_NOT_FOLLOWED ||
         warning.code == PNPBS_WARNING_SMALL_ANGLES;
}

// Returns the texts of the library's warnings. With nodes at centres no elements are written, so
// warnings about elements are left out.
std::vector<std::string> warnings_for(const Arguments& arguments, pnpbs_context context,
                                      pnpbs_placement placement) {
  std::vector<std::string> texts;
  for (const Warning& warning : warnings_of(context, placement))
    if (!arguments.at_centres || !is_about_elements(warning)) texts.push_back(warning.text);
  return texts;
}

// Returns the notes on the geographic file, the library's warnings, and those about grids.
std::vector<std::string> for_report(const Arguments& arguments, const GeoFile* geo,
                                    pnpbs_context context, pnpbs_placement placement,
                                    const std::vector<std::string>& of_grids) {
  std::vector<std::string> warnings;
  if (geo) warnings = geo->notes();
  for (const auto& more : {warnings_for(arguments, context, placement), of_grids})
    warnings.insert(warnings.end(), more.begin(), more.end());
  return warnings;
}

// Returns whether parts of the coasts are missing in the result, mostly lines outside the polygons.
bool leaves_out_shapes(const GeoFile& geo, pnpbs_context context, pnpbs_placement placement) {
  return geo.leaves_out_lines() ||
         std::ranges::any_of(warnings_of(context, placement), [](const Warning& warning) {
           return warning.code == PNPBS_WARNING_LEFT_OUT_OUTSIDE;
         });
}

// Prints the projection of a geographic file. This happens before d is requested, since the unit of
// d depends on it.
void print_projection(const GeoFile& geo) {
  const GeoFile::Projection projection = geo.projection();
  if (!projection.name.empty())
    std::cerr << "pnpbs: x and y are in '" << projection.name << "', in " << projection.unit
              << " (--projection, --unit)\n";
  for (const std::string& note : geo.notes()) std::cerr << "pnpbs: note: " << note << "\n";
}

void give_up_if_any_is_interrupted(const Ranks& ranks) {
  if (ranks.any(interrupted())) throw Interrupted();
}

double real_statistic(pnpbs_placement placement, const char* key, pnpbs_context context) {
  double value = 0;
  check(pnpbs_placement_get_double(placement, key, &value), context);
  return value;
}

std::int64_t statistic(pnpbs_placement placement, const char* key, pnpbs_context context) {
  std::int64_t value = 0;
  check(pnpbs_placement_get_int64(placement, key, &value), context);
  return value;
}

// Initialises the placement or restarts it from a checkpoint, checks the requests at the initial
// nodes, prints warnings, and runs unless the checkpoint is of a finished run.
pnpbs_status place(pnpbs_context context, pnpbs_placement placement, const Arguments& arguments,
                   const std::function<void()>& check_requests, const Ranks& ranks) {
  const bool talk = ranks.is_first() && !arguments.quiet;
  Progress progress(talk, arguments.progress);
  Checkpoints checkpoints(arguments.checkpoint, arguments.checkpoint_interval, placement, context,
                          ranks);
  progress.watch(placement, [&](double fraction, std::int64_t step, bool stop) {
    return checkpoints.turn(fraction, step, stop);
  });
  progress.say("laying the first nodes ...");
  if (arguments.restart.empty())
    check(pnpbs_placement_initialise(placement), context);
  else
    check(pnpbs_placement_read_checkpoint(placement, arguments.restart.c_str()), context);
  progress.clear();
  check_requests();
  const std::vector<std::string> warnings = warnings_for(arguments, context, placement);
  if (talk) warn(warnings);
  const bool finished = statistic(placement, "finished", context) != 0;
  const pnpbs_status status =
      finished ? static_cast<pnpbs_status>(statistic(placement, "status", context))
               : check(pnpbs_placement_run(placement), context);
  pnpbs_placement_set_monitor(placement, nullptr, nullptr);
  progress.clear();
  if (talk) warn(warnings_for(arguments, context, placement), warnings.size());
  if (ranks.any(interrupted())) throw Failure(ExitCode::interrupted, checkpoints.stop_message());
  checkpoints.write();
  if (arguments.check && check(pnpbs_placement_check(placement), context) == PNPBS_NOT_CONFORMING)
    return PNPBS_NOT_CONFORMING;
  return status;
}

bool wants_picture(const Arguments& arguments) {
  return std::any_of(arguments.outputs.begin(), arguments.outputs.end(),
                     [&](const std::string& path) {
                       const FileFormat* format = format_by_extension(path);
                       if (!format) format = format_by_name(arguments.format);
                       return format && format->picture;
                     });
}

// Prints the estimate of a run.
void print_estimate(pnpbs_context context, pnpbs_placement placement,
                    const std::optional<BodyFigures>& body, const Arguments& arguments,
                    const Ranks& ranks) {
  std::int64_t nodes = 0, bytes = 0;
  double seconds = 0;
  check(pnpbs_placement_estimate(placement, &nodes, &bytes, &seconds), context);
  give_up_if_any_is_interrupted(ranks);
  if (ranks.is_first())
    std::cout << estimate_text(
        {nodes, bytes, seconds, ranks.size(), wants_picture(arguments), body});
}

void set_options(pnpbs_context context, const Arguments& arguments) {
  // Options given by --set override those of the checkpoint.
  if (!arguments.restart.empty())
    check(pnpbs_context_set(context, "restart_options", "changed"), context);
  if (arguments.at_centres)  // elements are not used, so d is not reduced for their sake
    for (const char* key : {"conforming_rounds", "min_angle"})
      check(pnpbs_context_set(context, key, "0"), context);
  for (const auto& [key, value] : arguments.options)
    check(pnpbs_context_set(context, key.c_str(), value.c_str()), context);
}

// One run of the command.
struct Work {
  const Arguments& arguments;
  const Ranks& ranks;
  Requests requests;
  Context context;
  Domain domain;
  ParticleDomains particles;
  PictureLook look;
  std::optional<BodyFigures> body;
  pnpbs_domain filled() const { return arguments.at_centres ? particles.filled : domain; }
  pnpbs_domain body_of_particles() const { return arguments.in_walls ? particles.wall : domain; }
  bool talks() const { return ranks.is_first() && !arguments.quiet; }
};

void measure_body(Work& work) {
  if (work.requests.source->dimension() < 3) return;
  const bool filled = !work.arguments.surfaces_only && !work.arguments.sphere;
  work.ranks.collective_try([&] { work.body = body_figures(work.domain, filled, work.context); });
}

void centre_nodes(Work& work) {
  const int dimension = work.requests.source->dimension();
  work.ranks.collective_try([&] {
    work.particles.make(work.arguments, *work.requests.spacing, work.domain, dimension,
                        work.context);
  });
}

void read_domain(Work& work) {
  const Arguments& arguments = work.arguments;
  const DomainSource& source = *work.requests.source;
  Spacing& spacing = *work.requests.spacing;
  work.ranks.create_context(work.context.out());
  work.ranks.collective_try([&] {
    set_options(work.context, arguments);
    source.create(work.context, work.domain.out());
  });
  source.read(work.domain, work.context, work.ranks);
  if (source.geo() && work.talks()) print_projection(*source.geo());
  work.ranks.collective_try([&] {
    const std::string unit = unit_of_length(arguments, source.geo());
    work.requests.grids->read(work.domain, work.context, source.geo(), unit);
    spacing.use_read_grids(*work.requests.grids);
    if (work.requests.open_boundary) {
      const std::int64_t open = work.requests.open_boundary->tag(work.domain, work.context);
      if (work.talks())
        std::cerr << "pnpbs: note: segments of the boundary that are open: " << open << "\n";
    }
    if (arguments.simplify)
      spacing.simplify(work.domain, work.context, *arguments.simplify, arguments.smallest);
    work.look = look_of(arguments, source.dimension(), unit, work.domain, work.context);
  });
  measure_body(work);
  if (arguments.at_centres) centre_nodes(work);
}

// Sets the tags of cracks. Collective.
void set_cracks(const Work& work, pnpbs_placement placement) {
  if (work.arguments.cracks.empty()) return;
  const DomainSource& source = *work.requests.source;
  work.ranks.collective_try([&] {
    const std::vector<GroupName> names = group_names(work.domain, work.context);
    std::vector<std::int32_t> tags;
    for (const std::string& group : work.arguments.cracks) {
      tags.push_back(tag_of_facets(group, source.dimension() == 3 && !source.on_sphere() ? 2 : 1,
                                   names, "--crack"));
      // The call fails if nothing has the tag.
      check(pnpbs_domain_distance(work.domain, tags.back(), 0, nullptr, nullptr), work.context);
    }
    check(
        pnpbs_placement_set_cracks(placement, static_cast<std::int32_t>(tags.size()), tags.data()),
        work.context);
  });
}

void create(Work& work, Placement& placement) {
  check(pnpbs_placement_create(work.context, work.filled(), placement.out()), work.context);
  work.requests.spacing->give_to(placement, work.domain, work.context, work.ranks);
  set_cracks(work, placement);
}

pnpbs_status place(Work& work, pnpbs_placement placement) {
  Requests& requests = work.requests;
  const auto check_requests = [&] {
    if (requests.density) requests.density->check_at_nodes_of(placement, work.context, work.ranks);
    if (!requests.spacing->is_grid())
      requests.grids->require_values(placement, work.domain, work.context, work.ranks);
    requests.fields->check_at_nodes_of(placement, work.domain, work.context, work.ranks);
  };
  return place(work.context, placement, work.arguments, check_requests, work.ranks);
}

// Repairs the body to a resolution that d can resolve, if its elements do not conform and the user
// allows repairs. Returns whether the nodes have to be placed again.
bool repair_if_not_conforming(Work& work, pnpbs_status status, pnpbs_placement placement) {
  if (status != PNPBS_NOT_CONFORMING || !work.requests.source->may_be_repaired() ||
      real_statistic(placement, "repaired.resolution", work.context) > 0)
    return false;
  const double d = real_statistic(placement, "unresolved_spacing", work.context);
  if (work.talks())
    std::cerr
        << "pnpbs: note: the elements do not conform: the body is repaired, and nodes are placed "
           "again\n";
  work.ranks.collective_try([&] { work.requests.source->repair(work.domain, d, work.context); });
  measure_body(work);
  return true;
}

// Reports edges that are straight although curves and surfaces are not. Collective.
void report_straight_edges(const Work& work, pnpbs_placement placement) {
  std::int64_t count = 0, straight = 0;
  check(pnpbs_placement_get_edges(placement, 0, &count, &straight, nullptr, nullptr, nullptr),
        work.context);
  if (straight > 0 && work.ranks.is_first())
    std::cerr << "pnpbs: note: " << straight
              << " edges do not follow curves or surfaces, because elements of second order would "
                 "fold there: use a smaller d\n";
}

// Reports cracks that elements connect because they do not follow the surfaces. Collective.
void report_incomplete_cracks(const Work& work, pnpbs_placement placement) {
  constexpr double kNearlyAll = 0.999;  // chords of curved surfaces have a little less area
  std::int64_t count = 0;
  double covered = 1;
  check(pnpbs_placement_get_crack_facets(placement, 0, &count, &covered, nullptr, nullptr, nullptr),
        work.context);
  if (covered < kNearlyAll && work.ranks.is_first())
    std::cerr << "pnpbs: note: elements follow " << short_number(100 * covered, 4)
              << " percent of the cracks only, and connect their sides elsewhere: use a smaller "
                 "d there\n";
}

ExitCode write_results(Work& work, pnpbs_placement placement, pnpbs_status status) {
  auto& [arguments, ranks, requests, context, domain, particles, look, body] = work;
  Outputs& outputs = *requests.outputs;
  const GeoFile* geo = requests.source->geo();
  Statistics statistics(placement);
  if (outputs.has_pictures()) outputs.write_pictures({placement, domain, context, ranks, look});
  if (body && !arguments.at_centres && !arguments.sphere)
    body->area = boundary_area(placement, context, ranks);
  const Matter matter(arguments, requests.density, requests.source->dimension(), placement,
                      work.body_of_particles(), context, ranks);
  requests.fields->add_to(placement, matter.particles, domain, context, ranks);
  const std::vector<std::string> of_grids =
      requests.grids->warnings(placement, domain, context, ranks, requests.spacing->is_grid());
  if (work.talks()) warn(of_grids);
  const std::vector<std::string> warnings =
      for_report(arguments, geo, context, placement, of_grids);
  if (geo && !requests.source->on_sphere()) outputs.write_projection(geo->projection().prj);
  const std::vector<GroupName> groups = group_names(domain, context);
  const bool has_volume = body && body->volume > 0;
  std::vector<RegionRow> regions;
  if (!arguments.at_centres && !arguments.surfaces_only)
    regions = region_rows(placement, domain, has_volume ? 3 : 2, context);
  const auto report = [&] {
    return report_text(work.arguments, geo, statistics, matter.volumes, matter.figures, groups,
                       regions, has_volume, warnings);
  };
  outputs.write_report(report());
  give_up_if_any_is_interrupted(ranks);
  outputs.write_nodes(placement, matter.particles, context);
  if (arguments.order == 2) report_straight_edges(work, placement);
  if (!arguments.cracks.empty()) report_incomplete_cracks(work, placement);
  statistics.renew_memory(placement);  // writing files takes memory as well
  outputs.replace_report(report());
  if (work.talks() && !outputs.use_standard_output())
    std::cout << summary_text(statistics, body, regions, matter.volumes, matter.figures,
                              outputs.files());
  const bool of_elements = status == PNPBS_NOT_CONFORMING || status == PNPBS_SPACING_MISSED;
  if (arguments.at_centres && of_elements) status = PNPBS_OK;
  return geo && leaves_out_shapes(*geo, context, placement) ? ExitCode::input_left_out
                                                            : exit_code_of_run(status);
}

ExitCode run(const Arguments& arguments, const Ranks& ranks) {
  Work work{arguments, ranks, {arguments, ranks}, {}, {}, {}, {}, {}};
  read_domain(work);
  defer_interrupts(!arguments.checkpoint.empty());
  Placement given, repaired;
  create(work, given);
  if (arguments.dry_run) {
    print_estimate(work.context, given, work.body, arguments, ranks);
    return ExitCode::done;
  }
  work.requests.outputs->check_with_library(given, work.context);
  pnpbs_status status = place(work, given);
  if (!repair_if_not_conforming(work, status, given)) return write_results(work, given, status);
  check(pnpbs_placement_destroy(given.out()), work.context);
  create(work, repaired);
  status = place(work, repaired);
  return write_results(work, repaired, status);
}

// Readers such as head may close the pipe before the end.
void print(const std::string& text) {
  errno = 0;
  if (!(std::cout << text).flush() && errno != EPIPE)
    throw Failure(ExitCode::failed, "cannot write standard output");
}

ExitCode command(int argc, char** argv, const Ranks& ranks) {
  Arguments arguments;
  std::string answer;
  ranks.collective_try([&] { answer = parse_arguments(argc, argv, arguments); });
  const ExitCode code = answer.empty() ? run(arguments, ranks) : ExitCode::done;
  ranks.collective_try([&] {
    if (ranks.is_first()) print(answer);
  });
  return code;
}

ExitCode fail(ExitCode code, const std::string& message) {
  // one write, so that the output of ranks does not interleave
  std::cerr << "pnpbs: " + message + "\n";
  return code;
}

// A Failure is thrown on all ranks at the same point of the program (see Ranks). If any rank has
// received a signal, callbacks have failed for that reason.
ExitCode end_together(const Failure& failure, const Ranks& ranks) {
  const bool stopped = ranks.any(interrupted());
  const Failure reason =
      stopped && failure.code() != ExitCode::interrupted ? Interrupted() : failure;
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

int main(int argc, char** argv) {
  pnpbs::tool::set_wait_policy(argv);
  return static_cast<int>(pnpbs::tool::start(argc, argv));
}
