// SPDX-License-Identifier: BSD-3-Clause
#include "checkpoint/option_changes.hpp"

#include <algorithm>
#include <sstream>
#include <string_view>

#include "base/error.hpp"

namespace pnpbs {

namespace {

// Options that determine d. With other values, other nodes than the saved ones would be needed.
constexpr std::string_view kOfSpacing[] = {"growth_limit", "resolve", "wanted_nodes"};

// A line of the options in the checkpoint and at present; one of them may be empty.
struct LinePair {
  std::string then, now;
};

std::string name_in(const std::string& line) { return line.substr(0, line.find(" = ")); }
std::string value_in(const std::string& line) {
  const std::size_t sign = line.find(" = ");
  return sign == std::string::npos ? "" : line.substr(sign + 3);
}

std::vector<LinePair> different_lines(const std::string& then, const std::string& now) {
  std::istringstream in_then(then), in_now(now);
  std::vector<LinePair> pairs;
  for (;;) {
    LinePair pair;
    const bool more_then = static_cast<bool>(std::getline(in_then, pair.then));
    const bool more_now = static_cast<bool>(std::getline(in_now, pair.now));
    if (!more_then && !more_now) return pairs;
    if (!more_then) pair.then.clear();
    if (!more_now) pair.now.clear();
    if (pair.then != pair.now) pairs.push_back(std::move(pair));
  }
}

[[noreturn]] void refuse(const LinePair& pair, const std::string& remedy) {
  throw Error(ErrorKind::argument, "it was written with the option " + pair.then +
                                       ", and the placement has " + pair.now + ": " + remedy);
}

// Throws if the change is not allowed.
void require_requested(const LinePair& pair, const Options& now) {
  const std::string name = name_in(pair.now);
  if (name != name_in(pair.then) || now.choice("restart_options") == "same")
    refuse(pair, "set the same options; they may be changed once it is read");
  if (std::ranges::find(kOfSpacing, std::string_view(name)) != std::end(kOfSpacing))
    refuse(pair,
           "set the same one; the spacing depends on it, so it cannot be changed with a restart");
  if (!now.is_given(name.c_str()))
    refuse(pair, "set " + name + "=" + value_in(pair.then) +
                     " to continue as before, or another value to change it from here on");
}

}  // namespace

std::string lines_of_deciding(const Options& options) {
  std::string lines;
  for (const auto& [name, value] : options.deciding()) lines += name + " = " + value + "\n";
  return lines;
}

std::vector<OptionChange> changes_since(const std::string& saved_lines, const Options& now) {
  std::vector<OptionChange> changes;
  for (const LinePair& pair : different_lines(saved_lines, lines_of_deciding(now))) {
    require_requested(pair, now);
    changes.push_back({name_in(pair.now), value_in(pair.then), value_in(pair.now)});
  }
  return changes;
}

std::string text_of(const std::vector<OptionChange>& changes) {
  std::string text;
  for (const OptionChange& change : changes)
    text += (text.empty() ? "" : ", ") + change.name + " = " + change.now + " (" + change.then +
            " before)";
  return text;
}

}  // namespace pnpbs
