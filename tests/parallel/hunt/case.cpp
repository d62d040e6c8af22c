// SPDX-License-Identifier: BSD-3-Clause
// Builds a case from its specification: from a file, from explicit values or by random choices.

#include "case.hpp"

#include <cmath>
#include <filesystem>

#include "case_file.hpp"

namespace hunt {

namespace {

std::vector<std::string> files_of(const CaseSpec& spec) {
  if (!spec.files.empty()) return spec.files;
  std::vector<std::string> files;
  if (!spec.data.empty())
    for (const char* name : {"bracket.stl", "kleopatra.obj"})
      files.push_back(spec.data + "/" + name);
  return files;
}

Case explicit_case(const CaseSpec& spec) {
  Case made;
  made.body = file_body(spec.files.at(0));
  made.name = made.body.name;
  made.spacing.kind = spec.slope > 0 ? Spacing::Kind::grows : Spacing::Kind::constant;
  made.spacing.slope = spec.slope;
  made.spacing.from = spec.from;
  made.spacing.directions = made.body.dim;
  made.wanted_nodes = spec.nodes * spec.share;
  made.options = spec.options;
  return made;
}

Case replayed_case(const CaseSpec& spec) {
  Case made = read_case(spec.replay);
  if (!made.body.file.empty()) made.body.dim = file_body(made.body.file).dim;
  if (spec.default_options) made.options.clear();
  made.options.insert(made.options.end(), spec.options.begin(), spec.options.end());
  if (spec.once) made.by_steps = made.adapts = false;
  made.wanted_nodes *= spec.share;
  // The spacing determines the number of nodes if no number is requested.
  if (made.wanted_nodes == 0) {
    const double factor = std::pow(spec.share, -1.0 / made.body.dim);
    made.spacing.base *= factor;
    made.second.base *= factor;
  }
  return made;
}

Case random_case(const CaseSpec& spec) {
  Random body_random(spec.seed, spec.number, "body"),
      spacing_random(spec.seed, spec.number, "spacing"),
      option_random(spec.seed, spec.number, "options"),
      schedule_random(spec.seed, spec.number, "schedule");
  Case made;
  const bool in_plane = body_random.chance(0.25);
  const int dim = spec.dimensions == Dimensions::plane   ? 2
                  : spec.dimensions == Dimensions::space ? 3
                                                         : (in_plane ? 2 : 3);
  const double nodes = body_random.scale(120, dim == 2 ? 1000 : 400) * spec.share;
  made.body = spec.files.empty() ? random_body(body_random, dim, nodes, files_of(spec))
                                 : random_file(body_random, spec.files);
  made.spacing = random_spacing(spacing_random, made.body);
  made.second = random_spacing(spacing_random, made.body);
  const bool wants = spacing_random.chance(0.4);
  if (wants || made.spacing.kind != Spacing::Kind::constant || !made.body.file.empty() ||
      !made.body.solids.empty())
    made.wanted_nodes = nodes;
  if (!spec.default_options) made.options = random_options(option_random, made.body.dim);
  made.options.insert(made.options.end(), spec.options.begin(), spec.options.end());
  made.by_steps = schedule_random.chance(0.2) && !spec.once;
  made.steps = schedule_random.pick(1, 30);
  made.adapts = schedule_random.chance(0.25) && !spec.once;
  made.at_nodes = schedule_random.chance(0.4);
  if (made.adapts && made.wanted_nodes == 0) made.wanted_nodes = nodes;
  made.name = made.body.name + " d=" + made.spacing.name();
  if (made.adapts) made.name += made.at_nodes ? "+at-nodes" : "+" + made.second.name();
  if (made.by_steps) made.name += " by-steps";
  for (const auto& [key, value] : made.options) made.name += " " + key + "=" + value;
  return made;
}

}  // namespace

Case make_case(const CaseSpec& spec) {
  if (!spec.replay.empty()) return replayed_case(spec);
  Case made = spec.is_explicit ? explicit_case(spec) : random_case(spec);
  made.seed = spec.seed;
  made.number = spec.number;
  return made;
}

std::string label_of(const CaseSpec& spec) {
  if (!spec.replay.empty()) return std::filesystem::path(spec.replay).stem().string();
  return std::to_string(spec.seed) + ":" + std::to_string(spec.number);
}

}  // namespace hunt
