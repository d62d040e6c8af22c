// SPDX-License-Identifier: BSD-3-Clause
#include "tool/outputs.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "tool/exit.hpp"
#include "tool/interrupt.hpp"
#include "tool/names.hpp"

namespace pnpbs::tool {
namespace {

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const io::Format& format : io::formats()) names.emplace_back(format.name);
  return names;
}

std::string list_of_formats() {
  std::string list;
  for (const std::string& name : format_names()) list += (list.empty() ? "" : ", ") + name;
  return list;
}

const io::Format* format_called(const std::string& name) {
  if (name.empty()) return nullptr;
  const io::Format* format = io::format_by_name(name);
  if (format) return format;
  throw BadInput("--format: unknown format '" + name + "'" + did_you_mean(name, format_names()) +
                 " (known: " + list_of_formats() + ")");
}

const io::Format* format_of(const std::string& path, const io::Format* otherwise) {
  const io::Format* format = path == "-" ? nullptr : io::format_by_extension(path);
  if (!format) format = otherwise;
  if (format) return format;
  const std::string what = path == "-" ? "standard output" : "'" + path + "'";
  throw BadInput("--output: the name of " + what + " tells no format; give one of " +
                 list_of_formats() + " by extension or --format");
}

bool same_file(const std::string& a, const std::string& b) {
  if (a == "-" || b == "-") return a == b;
  std::error_code error;
  const auto full = [&error](const std::string& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path, error), error);
  };
  const bool special = std::filesystem::exists(a, error) && std::filesystem::is_other(a, error);
  return !special && full(a) == full(b);
}

io::NodeSet nodes_of(pnpbs_placement placement, pnpbs_context context) {
  std::int64_t count = 0;
  check(pnpbs_placement_count(placement, &count), context);
  const auto size = static_cast<std::size_t>(count);
  io::NodeSet nodes;
  nodes.xy.resize(2 * size);
  nodes.ids.resize(size);
  nodes.tags.resize(size);
  nodes.spacing.resize(size);
  check(pnpbs_placement_get_nodes(placement, count, nodes.xy.data(), nodes.ids.data(),
                                  nodes.tags.data(), nodes.spacing.data()),
        context);
  return nodes;
}

std::vector<std::int64_t> triangles_of(pnpbs_placement placement, pnpbs_context context) {
  std::int64_t count = 0;
  check(pnpbs_placement_get_triangles(placement, 0, &count, nullptr), context);
  std::vector<std::int64_t> triangles(3 * static_cast<std::size_t>(count));
  check(pnpbs_placement_get_triangles(placement, count, &count, triangles.data()), context);
  return triangles;
}

std::vector<double> outline_of(pnpbs_domain domain, pnpbs_context context) {
  std::int64_t count = 0;
  check(pnpbs_domain_get_segments(domain, 0, &count, nullptr, nullptr), context);
  std::vector<double> outline(4 * static_cast<std::size_t>(count));
  check(pnpbs_domain_get_segments(domain, count, &count, outline.data(), nullptr), context);
  return outline;
}

}  // namespace

Outputs::Outputs(const Arguments& arguments) : style_{arguments.bubbles} {
  const io::Format* otherwise = format_called(arguments.format);
  for (const std::string& path : arguments.outputs) add(path, format_of(path, otherwise));
  if (!arguments.report.empty()) add(arguments.report, nullptr);
  check();
}

void Outputs::add(const std::string& path, const io::Format* format) {
  if (path.empty()) throw BadInput("--output: the name of the file is empty");
  for (const Output& other : outputs_) {
    if (same_file(other.file.path(), path)) throw BadInput("'" + path + "' would be written twice");
  }
  outputs_.push_back({io::OutputFile(path), format});
}

void Outputs::check() const {
  for (const Output& output : outputs_) {
    try {
      output.file.check();
    } catch (const std::runtime_error& error) {
      throw BadInput(error.what());
    }
    const bool to_terminal = output.file.is_standard_output() && ::isatty(STDOUT_FILENO);
    if (to_terminal && output.format && output.format->binary) {
      throw BadInput("a ." + std::string(output.format->name) +
                     " file would upset the terminal; lead standard output elsewhere");
    }
  }
}

void Outputs::write(pnpbs_placement placement, pnpbs_domain domain, pnpbs_context context) {
  const auto any = [this](bool io::Format::*wish) {
    return std::ranges::any_of(outputs_,
                               [wish](const Output& o) { return o.format && o.format->*wish; });
  };
  if (std::ranges::none_of(outputs_, [](const Output& o) { return o.format; })) return;
  io::NodeSet nodes = nodes_of(placement, context);
  if (any(&io::Format::wants_triangles)) nodes.triangles = triangles_of(placement, context);
  if (any(&io::Format::wants_outline)) nodes.outline = outline_of(domain, context);
  for (Output& output : outputs_) {
    if (!output.format) continue;
    output.file.write([&](io::Sink& sink) { output.format->write(nodes, style_, sink); },
                      give_up_if_interrupted);
  }
}

void Outputs::write_report(const std::string& text) {
  for (Output& output : outputs_) {
    if (output.format) continue;
    output.file.write([&](io::Sink& sink) { sink.text(text); }, give_up_if_interrupted);
  }
}

void Outputs::publish() {
  for (Output& output : outputs_) output.file.publish();
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
