// SPDX-License-Identifier: BSD-3-Clause
// Parses the arguments of the command line and of the file of kept cases.

#include "arguments.hpp"

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <sstream>

#include "number_text.hpp"

namespace hunt {

const char* const kUsage =
    "usage: hunt [--seed N | --seed today] --cases A..B | --case SEED:NUMBER | --replay FILE |\n"
    "            --kept FILE\n"
    "            [--dump FOLDER] [--seconds N] [--plane | --space] [--data FOLDER] "
    "[--files FILE,...]\n"
    "            [--shrink] [--all]\n"
    "            [--ranks N [--interval N] [--metis-seed N] [--rebalance] [--serial]]\n"
    "            [--threads N,...] [--once] [--default-options] [--share X] [--set KEY=VALUE]\n"
    "            [--option KEY=VALUE] [--nodes N [--slope X --from X,Y,Z]] "
    "[--expect-differences]\n";

namespace {

std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

std::uint64_t number(const std::string& text) { return std::strtoull(text.c_str(), nullptr, 10); }
double real(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

std::uint64_t today() {
  const std::time_t now = std::time(nullptr);
  const std::tm* const date = std::gmtime(&now);
  return static_cast<std::uint64_t>((date->tm_year + 1900) * 10000 + (date->tm_mon + 1) * 100 +
                                    date->tm_mday);
}

bool take_flag(const std::string& word, Arguments& made) {
  const auto group = [&]() -> Configuration& {
    if (!made.group) made.group.emplace();
    return *made.group;
  };
  if (word == "--plane")
    made.spec.dimensions = Dimensions::plane;
  else if (word == "--space")
    made.spec.dimensions = Dimensions::space;
  else if (word == "--shrink")
    made.shrinks = true;
  else if (word == "--all")
    made.tells_all = true;
  else if (word == "--once")
    made.spec.once = true;
  else if (word == "--default-options")
    made.spec.default_options = true;
  else if (word == "--expect-differences")
    made.expects_differences = true;
  else if (word == "--rebalance")
    group().rebalances = true;
  else if (word == "--serial")
    group().serial = true;
  else
    return false;
  return true;
}

bool take_group(const std::string& word, const std::string& value, Arguments& made) {
  int Configuration::*member = word == "--ranks"        ? &Configuration::ranks
                               : word == "--interval"   ? &Configuration::interval
                               : word == "--metis-seed" ? &Configuration::metis_seed
                                                        : nullptr;
  if (!member) return false;
  if (!made.group) made.group.emplace();
  (*made.group).*member = static_cast<int>(number(value));
  return true;
}

bool take_explicit(const std::string& word, const std::string& value, Arguments& made) {
  if (word == "--nodes") {
    made.spec.is_explicit = true;
    made.spec.nodes = real(value);
  } else if (word == "--slope") {
    made.spec.slope = real(value);
  } else if (word == "--from") {
    const std::vector<std::string> parts = parts_of(value);
    for (std::size_t k = 0; k < 3 && k < parts.size(); ++k) made.spec.from[k] = real(parts[k]);
  } else {
    return false;
  }
  return true;
}

bool take_value(const std::string& word, const std::string& value, Arguments& made) {
  const std::size_t colon = value.find(':'), dots = value.find(".."), equals = value.find('=');
  if (word == "--seed") {
    made.spec.seed = value == "today" ? today() : number(value);
  } else if (word == "--cases" && dots != std::string::npos) {
    made.first = number(value);
    made.last = number(value.substr(dots + 2));
  } else if (word == "--seconds") {
    made.seconds = real(value);
  } else if (word == "--case" && colon != std::string::npos) {
    made.spec.seed = number(value);
    made.first = number(value.substr(colon + 1));
    made.last = made.first + 1;
  } else if (word == "--kept") {
    made.kept = value;
  } else if (word == "--data") {
    made.spec.data = value;
  } else if (word == "--files") {
    made.spec.files = parts_of(value);
  } else if (word == "--replay") {
    made.spec.replay = value;
    made.last = made.first + 1;
  } else if (word == "--dump") {
    made.dump = value;
  } else if (word == "--share") {
    made.spec.share = real(value);
  } else if (word == "--threads") {
    made.threads.clear();
    for (const std::string& part : parts_of(value))
      made.threads.push_back(static_cast<int>(number(part)));
  } else if (word == "--set" && equals != std::string::npos) {
    made.extra.emplace_back(value.substr(0, equals), value.substr(equals + 1));
  } else if (word == "--option" && equals != std::string::npos) {
    made.spec.options.emplace_back(value.substr(0, equals), value.substr(equals + 1));
  } else {
    return take_group(word, value, made) || take_explicit(word, value, made);
  }
  return true;
}

}  // namespace

Arguments parsed(const std::vector<std::string>& words, Arguments made) {
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (take_flag(words[k], made)) continue;
    if (k + 1 == words.size() || !take_value(words[k], words[k + 1], made)) {
      made.error = "hunt: cannot read \"" + words[k] + "\"";
      return made;
    }
    ++k;
  }
  if (made.spec.is_explicit && made.spec.files.size() != 1)
    made.error = "hunt: --nodes needs one file by --files";
  return made;
}

std::vector<std::vector<std::string>> lines_of(const std::string& path) {
  std::vector<std::vector<std::string>> lines;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::stringstream stream(line.substr(0, line.find('#')));
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    if (!words.empty()) lines.push_back(words);
  }
  return lines;
}

std::string arguments_of(const CaseSpec& spec) {
  std::string text = spec.replay.empty() ? "--case " + label_of(spec) : "--replay " + spec.replay;
  if (spec.dimensions != Dimensions::both)
    text += spec.dimensions == Dimensions::plane ? " --plane" : " --space";
  for (std::size_t k = 0; k < spec.files.size(); ++k)
    text += (k ? "," : " --files ") + spec.files[k];
  if (spec.is_explicit) {
    text += " --nodes " + text_of(spec.nodes) + " --slope " + text_of(spec.slope) + " --from " +
            text_of(spec.from[0]) + "," + text_of(spec.from[1]) + "," + text_of(spec.from[2]);
  } else if (!spec.data.empty()) {
    text += " --data " + spec.data;
  }
  if (spec.once) text += " --once";
  if (spec.default_options) text += " --default-options";
  if (spec.share != 1) text += " --share " + text_of(spec.share);
  for (const auto& [key, value] : spec.options) text += " --option " + key + "=" + value;
  return text;
}

}  // namespace hunt
