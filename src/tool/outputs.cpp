// SPDX-License-Identifier: BSD-3-Clause
#include "tool/outputs.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "base/extension.hpp"
#include "tool/exit.hpp"
#include "tool/geo_file.hpp"
#include "tool/interrupt.hpp"
#include "tool/named_grid.hpp"
#include "tool/names.hpp"
#include "tool/spacing.hpp"

namespace pnpbs::tool {
namespace {

const FileFormat* format_called(const std::string& name) {
  if (name.empty()) return nullptr;
  const FileFormat* format = format_by_name(name);
  if (format) return format;
  throw BadInput("--format: unknown format '" + name + "'" + did_you_mean(name, format_names()) +
                 " (known: " + list_of_formats() + ")");
}

const FileFormat* format_of(const std::string& path, const FileFormat* otherwise) {
  const FileFormat* format = path == "-" ? nullptr : format_by_extension(path);
  if (!format) format = otherwise;
  if (format) return format;
  const std::string what = path == "-" ? "standard output" : "'" + path + "'";
  throw BadInput("--output: " + what + " has no recognised extension; give one of " +
                 list_of_formats() + " by extension or --format");
}

bool same_file(const std::string& a, const std::string& b) {
  if (a == "-" || b == "-") return a == b;
  std::error_code error;
  const auto full = [&error](const std::string& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path, error), error);
  };
  const bool special = std::filesystem::exists(a, error) && std::filesystem::is_other(a, error);
  return !special && (full(a) == full(b) || std::filesystem::equivalent(a, b, error));
}

std::string projection_beside(const std::string& path) {
  return std::filesystem::path(path).replace_extension(".prj").string();
}

void refuse_to_replace(const std::string& input, const std::string& path) {
  if (!input.empty() && input != "-" && same_file(input, path))
    throw BadInput("'" + path + "' would overwrite an input file: write to another file");
}

std::string file_of_spacing(const Arguments& arguments) {
  const auto file = spacing_file(arguments.spacing);
  return file ? file->path : "";
}

}  // namespace

Outputs::Outputs(const Arguments& arguments, const Ranks& ranks)
    : ranks_(ranks), order_(arguments.nodes_only || arguments.at_centres ? 0 : arguments.order) {
  const FileFormat* otherwise = format_called(arguments.format);
  for (const std::string& path : arguments.outputs) add(path, format_of(path, otherwise));
  if (!arguments.report.empty()) add(arguments.report, nullptr);
  if (GeoFile::is_meant_by(arguments) && !arguments.sphere) add_projections(arguments.domain);
  std::vector<std::string> inputs{arguments.domain, file_of_spacing(arguments),
                                  arguments.projection};
  for (const std::string& grid : arguments.spacing_grids) inputs.push_back(path_of_grid(grid));
  if (arguments.depth_rule) inputs.push_back(path_of_grid(arguments.depth_rule->grid));
  for (const Output& output : outputs_)
    for (const std::string& input : inputs) refuse_to_replace(input, output.file.path());
  for (const std::string& path : {arguments.checkpoint, arguments.restart}) refuse_checkpoint(path);
  check_pictures(arguments);
  check_order();
  if (arguments.at_centres) check_particles();
  if (ranks_.is_first()) check_writable();
}

void Outputs::add(const std::string& path, const FileFormat* format) {
  if (path.empty()) throw BadInput("--output: the name of the file is empty");
  for (const Output& other : outputs_) {
    if (same_file(other.file.path(), path)) throw BadInput("'" + path + "' would be written twice");
  }
  if (path == "-" && format && format->name == "pvtu")
    throw BadInput("--output: a .pvtu file and its pieces cannot go to standard output");
  outputs_.push_back({io::OutputFile(path), format, false});
}

// Results may have the checkpoint's extension, but a run can only restart from a checkpoint.
void Outputs::refuse_checkpoint(const std::string& path) const {
  if (path.empty()) return;
  for (const Output& output : outputs_)
    if (same_file(output.file.path(), path))
      throw BadInput("--output: '" + path + "' is the checkpoint: write to another file");
}

void Outputs::add_projections(const std::string& input) {
  std::vector<std::string> paths;
  for (const Output& output : outputs_)
    if (output.is_nodes() && !output.file.is_standard_output())
      paths.push_back(projection_beside(output.file.path()));
  for (const std::string& path : paths) {
    // A shapefile has a .prj file of its own.
    if (extension_of(input) == "shp") refuse_to_replace(projection_beside(input), path);
    const auto is_it = [&](const Output& other) { return same_file(other.file.path(), path); };
    if (std::ranges::none_of(outputs_, is_it))
      outputs_.push_back({io::OutputFile(path), nullptr, true});
  }
}

void Outputs::check_order() const {
  const auto holds_elements = [](const Output& output) {
    return output.is_nodes() && output.format->elements;
  };
  if (order_ == 2 && std::ranges::none_of(outputs_, holds_elements))
    throw BadInput("--order: there is no file with elements; add --output FILE.vtu or FILE.msh");
}

void Outputs::check_pictures(const Arguments& arguments) const {
  if (has_pictures()) return;
  const std::string add = "; add --output FILE.png or FILE.svg";
  if (arguments.colour.value_or(picture::ElementColour::none) != picture::ElementColour::none)
    throw BadInput("--color: there is no picture to colour" + add);
  if (!arguments.cut.empty()) throw BadInput("--cut: there is no picture of a body" + add);
}

void Outputs::check_particles() const {
  for (const Output& output : outputs_)
    if (output.is_nodes())
      for (const std::string_view name : {"pvtu", "ele", "face"})
        if (output.format->name == name)
          throw BadInput("--output: a ." + output.format->name +
                         " file cannot contain particles, which have no elements: '" +
                         output.file.path() + "'");
}

bool Outputs::has_pictures() const { return std::ranges::any_of(outputs_, &Output::is_picture); }

void Outputs::check_writable() const {
  for (const Output& output : outputs_) {
    try {
      output.file.check();
    } catch (const std::runtime_error& error) {
      throw BadInput(error.what());
    }
    // A launcher may connect this process to a terminal although the output goes elsewhere.
    const bool to_terminal =
        output.file.is_standard_output() && !ranks_.launched() && ::isatty(STDOUT_FILENO);
    if (to_terminal && output.format && output.format->binary) {
      throw BadInput("a ." + output.format->name +
                     " file is binary and cannot go to a terminal: redirect standard output");
    }
  }
}

void Outputs::write_pictures(const GatheredPicture& picture) {
  ranks_.collective_try([&] {
    if (!ranks_.is_first()) return;
    const picture::Drawing drawing = picture.drawing();
    for (Output& output : outputs_) {
      if (!output.is_picture()) continue;
      give_up_if_interrupted();
      output.file.write([&](io::Sink& sink) { output.format->picture->write(drawing, sink); },
                        give_up_if_interrupted);
    }
  });
}

void Outputs::write_text(bool is_projection, const std::string& text) {
  ranks_.collective_try([&] {
    if (!ranks_.is_first()) return;
    for (Output& output : outputs_) {
      if (output.format || output.is_projection != is_projection) continue;
      give_up_if_interrupted();
      output.file.write([&](io::Sink& sink) { sink.text(text); }, give_up_if_interrupted);
    }
  });
}

void Outputs::write_report(const std::string& text) { write_text(false, text); }

void Outputs::write_projection(const std::string& text) {
  if (text.empty())
    std::erase_if(outputs_, [](const Output& output) { return output.is_projection; });
  else
    write_text(true, text);
}

pnpbs_status Outputs::ask_for_nodes(pnpbs_placement placement, pnpbs_particles particles) const {
  std::vector<const char*> paths, formats;
  std::vector<std::int32_t> elements;
  for (const Output& output : outputs_) {
    if (!output.is_nodes()) continue;
    paths.push_back(output.file.path().c_str());
    formats.push_back(output.format->name.c_str());
    elements.push_back(output.format->elements ? order_ : 0);
  }
  const auto n = static_cast<std::int32_t>(paths.size());
  if (particles) return pnpbs_particles_write(particles, n, paths.data(), formats.data());
  return pnpbs_placement_write_files(placement, n, paths.data(), formats.data(), elements.data());
}

// The library rejects formats that it cannot write before there are nodes. Otherwise it reports
// PNPBS_ERROR_STATE, since there are no nodes.
void Outputs::check_with_library(pnpbs_placement placement, pnpbs_context context) const {
  const pnpbs_status status = ask_for_nodes(placement, nullptr);
  if (status != PNPBS_ERROR_STATE) check(status, context);
}

void Outputs::write_nodes(pnpbs_placement placement, pnpbs_particles particles,
                          pnpbs_context context) {
  pnpbs_placement_set_monitor(placement, monitor, this);
  const pnpbs_status status = ask_for_nodes(placement, particles);
  pnpbs_placement_set_monitor(placement, nullptr, nullptr);
  settle_own(status >= 0 && status != PNPBS_STOPPED);
  ranks_.collective_try([&] {
    if (failure_) std::rethrow_exception(failure_);
  });
  if (status == PNPBS_STOPPED) throw Interrupted();
  // After the run, a file error is a failure rather than bad input.
  if (status == PNPBS_ERROR_FILE) throw Failure(ExitCode::failed, pnpbs_last_error(context));
  check(status, context);
}

void Outputs::replace_report(const std::string& text) {
  if (!ranks_.is_first()) return;
  for (const Output& output : outputs_) {
    if (!output.is_report() || !output.file.written_aside()) continue;
    try {
      io::OutputFile replacement(output.file.path());
      replacement.write([&](io::Sink& sink) { sink.text(text); }, [] {});
      if (begin_commit())
        io::publish_together({&replacement}, [](const std::function<void()>& step) { step(); });
    } catch (const std::exception&) {
      // The old report stays, as the header says.
    }
    end_commit();
  }
}

// ------------------------------------------------------------------ all of them together -------

// The library calls the monitor a last time, with fraction 1, when its files are complete on all
// ranks and before the first of them is renamed. The files of the command are published at the same
// time.
std::int32_t Outputs::monitor(double fraction, std::int64_t, std::int64_t, double, void* user) {
  if (fraction < 1) return interrupted();
  return begin_commit() && static_cast<Outputs*>(user)->publish_own() ? 0 : 1;
}

bool Outputs::publish_own() {
  try {
    for (Output& output : outputs_) output.file.seal();
    for (Output& output : outputs_) output.file.publish();
    return true;
  } catch (...) {
    failure_ = std::current_exception();
    return false;
  }
}

// Keeps or withdraws the files of the command, as the library did with its own.
void Outputs::settle_own(bool published) {
  for (Output& output : outputs_) {
    if (published)
      output.file.settle();
    else
      output.file.withdraw();
  }
  end_commit();
}

bool Outputs::use_standard_output() const {
  return std::ranges::any_of(outputs_, [](const Output& o) { return o.file.is_standard_output(); });
}

std::vector<std::string> Outputs::files() const {
  std::vector<std::string> files;
  for (const Output& output : outputs_) {
    if (!output.file.is_standard_output()) files.push_back(output.file.path());
  }
  return files;
}

}  // namespace pnpbs::tool
