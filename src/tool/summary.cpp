// SPDX-License-Identifier: BSD-3-Clause
#include "tool/summary.hpp"

#include "tool/numbers.hpp"

namespace pnpbs::tool {
namespace {

std::string nodes_line(const Statistics& statistics) {
  const auto* nodes = statistics.find<std::int64_t>("nodes");
  const auto* boundary = statistics.find<std::int64_t>("boundary_nodes");
  const auto* seconds = statistics.find<double>("seconds.total");
  if (!nodes) return "";
  std::string line = "nodes    " + grouped(*nodes);
  if (boundary) line += ", " + grouped(*boundary) + " of them on the boundary";
  if (seconds) line += ", in " + duration(*seconds);
  return line + "\n";
}

std::string spacing_line(const Statistics& statistics) {
  const auto* mean = statistics.find<double>("d_error.mean");
  const auto* deviation = statistics.find<double>("d_error.deviation");
  const auto* least = statistics.find<double>("d_error.least");
  if (!mean || !deviation) return "";
  std::string line = "spacing  nearest neighbour at " + short_number(*mean, 4) + " d +- " +
                     short_number(*deviation, 2);
  if (least) line += ", least " + short_number(*least, 2) + " d";
  return line + "\n";
}

// The library says what ended the run in a word or two.
std::string in_words(const std::string& reason) {
  if (reason == "rest") return "the bubbles rest";
  if (reason == "step limit") return "the step limit, before the bubbles rested";
  return reason;
}

std::string stop_line(const Statistics& statistics) {
  const auto* steps = statistics.find<std::int64_t>("steps");
  const auto* reason = statistics.find<std::string>("stop_reason");
  if (!reason) return "";
  std::string line = "stopped  ";
  if (steps) line += "after " + grouped(*steps) + " steps: ";
  return line + in_words(*reason) + "\n";
}

std::string files_line(const std::vector<std::string>& files) {
  if (files.empty()) return "wrote    nothing: name files with --output\n";
  std::string line;
  for (const std::string& file : files) line += (line.empty() ? "wrote    " : ", ") + file;
  return line + "\n";
}

}  // namespace

std::string summary_text(const Statistics& statistics, const std::vector<std::string>& files) {
  return nodes_line(statistics) + spacing_line(statistics) + stop_line(statistics) +
         files_line(files);
}

}  // namespace pnpbs::tool
