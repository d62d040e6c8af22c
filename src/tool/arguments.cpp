// SPDX-License-Identifier: BSD-3-Clause
#include "tool/arguments.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "tool/exit.hpp"
#include "tool/help.hpp"
#include "tool/library.hpp"
#include "tool/names.hpp"

namespace pnpbs::tool {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw BadInput(what + "\nTry 'pnpbs --help'.");
}

struct Questions {
  bool help = false, version = false, statistics = false;
};

// Each occurrence takes one value: "--output a --output b".
void add_repeatable(CLI::App& app, const std::string& name, std::vector<std::string>& values,
                    const std::string& help) {
  app.add_option(name, values, help)->allow_extra_args(false)->take_all();
}

void add_input(CLI::App& app, Arguments& arguments) {
  const std::string group = "What to fill";
  app.add_option("--domain", arguments.domain,
                 "the domain: a file in Triangle's .poly format, - for\nstandard input")
      ->type_name("FILE")
      ->group(group);
  app.add_option("--spacing", arguments.spacing,
                 "wanted distance d between neighbouring nodes: a number, or\na formula in x and y "
                 "such as '1 + 0.02*hypot(x,y)'")
      ->type_name("EXPR")
      ->group(group);
  app.add_option("--spacing-grid", arguments.spacing_grid,
                 "instead: d sampled on an ESRI ASCII grid (.asc)")
      ->type_name("FILE")
      ->group(group);
}

void take_colour(const std::string& name, Arguments& arguments) {
  const std::vector<std::string> names = picture::triangle_colour_names();
  const auto colour = picture::triangle_colour_called(name);
  if (!colour) {
    std::string known;
    for (const std::string& each : names) known += (known.empty() ? "" : ", ") + each;
    refuse("--color: unknown value '" + name + "'" + did_you_mean(name, names) +
           " (known: " + known + ")");
  }
  arguments.colour = *colour;
}

void add_output(CLI::App& app, Arguments& arguments) {
  const std::string group = "What to write";
  add_repeatable(app, "-o,--output", arguments.outputs,
                 "file to write, format by its extension (below); may be\ngiven several times; - "
                 "for standard output");
  app.get_option("--output")->type_name("FILE")->group(group);
  app.add_option("--format", arguments.format, "format of standard output and of other extensions")
      ->type_name("NAME")
      ->group(group);
  app.add_option("--report", arguments.report, "statistics as JSON, - for standard output")
      ->type_name("FILE")
      ->group(group);
  app.add_flag("--nodes-only", arguments.nodes_only,
               "no triangles in files that may be without (.vtu, .pvtu,\n.msh)")
      ->group(group);
  app.add_flag("--bubbles", arguments.bubbles, "draw the bubbles in pictures")->group(group);
  app.add_option_function<std::string>(
         "--color", [&arguments](const std::string& name) { take_colour(name, arguments); },
         "colour the triangles in pictures by quality, edge (mean\nlength over d) or spacing (d); "
         "default: none")
      ->type_name("BY")
      ->group(group);
}

void add_general(CLI::App& app, Arguments& arguments, Questions& questions) {
  const std::string group = "Others";
  app.set_help_flag();
  app.add_flag(
         "--dry-run", arguments.dry_run,
         "tell about how many nodes, how much memory and time it would\ntake; place and write "
         "nothing")
      ->group(group);
  app.add_flag("-q,--quiet", arguments.quiet, "print nothing but errors")->group(group);
  app.add_flag("--progress", arguments.progress,
               "a progress bar even where standard error is no terminal,\nas under mpirun")
      ->group(group);
  app.add_flag(
         "--check", arguments.check,
         "check the results before they are written: lists, triangles,\narea; an error if any "
         "of it is wrong")
      ->group(group);
  app.add_flag("-h,--help", questions.help, "this text")->group(group);
  app.add_flag("--version", questions.version, "version, and what it was built with")->group(group);
  app.add_flag("--list-statistics", questions.statistics, "the keys of the report")->group(group);
}

// Short ways to say --set key=value, for those of these options that the library has.
void add_library_options(CLI::App& app, Arguments& arguments, std::vector<std::string>& settings) {
  const std::string group = "How to do it";
  add_repeatable(app, "--set", settings, "set an option of the library (below); may be repeated");
  app.get_option("--set")->type_name("KEY=VALUE")->group(group);
  for (const LibraryOption& option : library_options()) {
    if (option.name != "steps" && option.name != "threads" && option.name != "growth_limit")
      continue;
    std::string flag = "--" + option.name;
    std::ranges::replace(flag, '_', '-');
    app.add_option_function<std::string>(
           flag,
           [&arguments, key = option.name](const std::string& value) {
             arguments.options.emplace_back(key, value);
           },
           "the same as --set " + option.name + "=VALUE")
        ->type_name("VALUE")
        ->group(group);
  }
}

void refuse_unknown(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  for (const std::string& word : app.remaining()) {
    if (word == "--") continue;
    if (!word.starts_with('-')) refuse("unexpected argument '" + word + "'");
    const std::string name = word.substr(0, word.find('='));
    refuse("unknown option " + name + did_you_mean(name, names));
  }
}

void take_settings(const std::vector<std::string>& settings, Arguments& arguments) {
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) {
      refuse("--set: expected KEY=VALUE, found '" + setting + "'");
    }
    arguments.options.emplace_back(setting.substr(0, equals), setting.substr(equals + 1));
  }
}

void check_input(const Arguments& arguments) {
  if (arguments.domain.empty()) refuse("--domain is missing");
  if (arguments.spacing.empty() && arguments.spacing_grid.empty()) {
    refuse("--spacing or --spacing-grid is missing");
  }
  if (!arguments.spacing.empty() && !arguments.spacing_grid.empty()) {
    refuse("--spacing and --spacing-grid exclude each other");
  }
  if (arguments.bubbles && arguments.colour != picture::TriangleColour::none) {
    refuse("--bubbles and --color exclude each other");
  }
}

// One empty line between groups is enough.
std::string compact(std::string text) {
  for (std::size_t at; (at = text.find("\n\n\n")) != std::string::npos;) text.erase(at, 1);
  return text;
}

}  // namespace

std::string parse_arguments(int argc, char** argv, Arguments& arguments) {
  CLI::App app("Places nodes in a plane domain so that their distances follow a spacing function.",
               "pnpbs");
  Questions questions;
  std::vector<std::string> settings;
  app.allow_extras();
  app.get_formatter()->column_width(28);
  add_input(app, arguments);
  add_output(app, arguments);
  add_library_options(app, arguments, settings);
  add_general(app, arguments, questions);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    refuse(error.what());
  }
  refuse_unknown(app);
  std::string answer;
  if (questions.help) answer += compact(app.help()) + help_tables();
  if (questions.version) answer += version_text();
  if (questions.statistics) answer += statistics_text();
  if (!answer.empty()) return answer;
  take_settings(settings, arguments);
  check_input(arguments);
  return "";
}

}  // namespace pnpbs::tool
