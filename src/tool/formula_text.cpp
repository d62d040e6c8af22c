// SPDX-License-Identifier: BSD-3-Clause
#include "tool/formula_text.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "tool/exit.hpp"
#include "tool/names.hpp"

namespace pnpbs::tool {
namespace {

// Returns the number of characters before the byte at `position`. Continuation bytes of UTF-8 do
// not count.
std::size_t letters_before(const std::string& text, std::size_t position) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(position),
                    [](unsigned char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

void fail_at(const FormulaSource& source, std::size_t position, const std::string& what) {
  const std::string& text = source.text;
  const std::size_t column = letters_before(text, std::min(position, text.size()));
  std::string line = text;
  std::ranges::replace_if(
      line, [](unsigned char c) { return c < ' '; }, ' ');
  throw BadInput(source.option + ", position " + std::to_string(column + 1) + ": " + what + "\n  " +
                 line + "\n  " + std::string(column, ' ') + "^");
}

void reject_invalid_formula(const FormulaSource& source) {
  const std::string& text = source.text;
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    fail_at(source, 0, "empty expression");
  for (std::size_t at = text.find('='); at != std::string::npos; at = text.find('=', at + 1)) {
    const bool comparison =
        (at > 0 && std::string("<>!=").find(text[at - 1]) != std::string::npos) ||
        (at + 1 < text.size() && text[at + 1] == '=');
    if (!comparison) fail_at(source, at, "a formula assigns nothing (== compares)");
  }
}

namespace {

// A function call whose opening parenthesis is at `open`: its number of arguments, and its end or
// npos.
struct Call {
  int arguments = 1;
  std::size_t end = std::string::npos;
};
Call call_at(const std::string& text, std::size_t open) {
  Call call;
  int depth = 0;
  for (std::size_t at = open; at < text.size(); ++at) {
    if (text[at] == '(') ++depth;
    if (text[at] == ',' && depth == 1) ++call.arguments;
    if (text[at] == ')' && --depth == 0) {
      if (text.find_first_not_of(" \t", open + 1) == at) call.arguments = 0;
      call.end = at;
      break;
    }
  }
  return call;
}

bool in_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

}  // namespace

void refuse_other_hypots(const FormulaSource& source) {
  constexpr std::string_view name = "hypot";
  const std::string& text = source.text;
  for (std::size_t at = text.find(name); at != std::string::npos;
       at = text.find(name, at + name.size())) {
    const std::size_t open = at + name.size();
    if (open == text.size() || text[open] != '(' || (at > 0 && in_name(text[at - 1]))) continue;
    const Call call = call_at(text, open);
    if (call.end == std::string::npos || call.arguments == 2 || call.arguments == 3) continue;
    fail_at(source, call.end,
            std::string("too ") + (call.arguments < 2 ? "few" : "many") +
                " arguments for 'hypot': it takes two, or three in space, as in hypot(x,y,z)");
  }
}

bool mentions(const std::string& formula, const std::string& name) {
  const auto is_part = [&](std::size_t at) { return at < formula.size() && in_name(formula[at]); };
  for (std::size_t at = formula.find(name); at != std::string::npos;
       at = formula.find(name, at + 1))
    if (!(at > 0 && is_part(at - 1)) && !is_part(at + name.size())) return true;
  return false;
}

std::vector<std::string> calls_of(const std::string& function, const std::string& formula) {
  std::vector<std::string> calls;
  for (std::size_t at = formula.find(function); at != std::string::npos;
       at = formula.find(function, at + 1)) {
    const std::size_t open = formula.find_first_not_of(" \t", at + function.size());
    if (open == std::string::npos || formula[open] != '(' || (at > 0 && in_name(formula[at - 1])))
      continue;
    const std::size_t end = call_at(formula, open).end;
    if (end != std::string::npos) calls.push_back(formula.substr(at, end + 1 - at));
  }
  return calls;
}

namespace {

// Returns the end of the argument of dist(...) that begins at `begin`: a quoted name, or letters,
// digits and underscores.
std::size_t end_of_argument(const std::string& text, std::size_t begin) {
  const char first = text[begin];
  std::size_t end = begin + 1;
  if (first == '\'' || first == '"') {
    end = text.find(first, end);
    return end == std::string::npos ? text.size() : end + 1;
  }
  while (end < text.size() && in_name(text[end])) ++end;
  return end;
}

// Returns the group that text[begin, end) names, and replaces quotes and characters that are not
// part of names in the text by underscores.
NamedGroup name_group(std::string& text, std::size_t begin, std::size_t end) {
  std::string name = text.substr(begin, end - begin);
  if (!in_name(name[0])) name = name.substr(1, name.size() - 2);
  std::replace_if(
      text.begin() + static_cast<std::ptrdiff_t>(begin),
      text.begin() + static_cast<std::ptrdiff_t>(end), [](char c) { return !in_name(c); }, '_');
  return {name, text.substr(begin, end - begin)};
}

}  // namespace

std::vector<NamedGroup> groups_in(std::string& text) {
  constexpr std::string_view name = "dist";
  std::vector<NamedGroup> groups;
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
    std::size_t before = text.find_first_not_of(" \t", at + name.size());
    if (before == std::string::npos || text[before] != '(' || (at > 0 && in_name(text[at - 1])))
      continue;
    // `before` is the parenthesis or comma before an argument.
    while (before < text.size() && (text[before] == '(' || text[before] == ',')) {
      const std::size_t begin = text.find_first_not_of(" \t", before + 1);
      if (begin == std::string::npos) break;
      const std::size_t end = end_of_argument(text, begin);
      const std::size_t after = std::min(text.find_first_not_of(" \t", end), text.size());
      if (after == text.size() || (text[after] != ')' && text[after] != ',')) break;
      const bool quoted = text[begin] == '\'' || text[begin] == '"';
      const bool is_number = std::isdigit(static_cast<unsigned char>(text[begin])) != 0;
      if (quoted || (in_name(text[begin]) && !is_number))
        groups.push_back(name_group(text, begin, end));
      before = after;
    }
  }
  return groups;
}

double tag_of_group(const std::string& group, const std::vector<GroupName>& names,
                    const std::string& option) {
  std::vector<std::string> known;
  const GroupName* found = nullptr;
  for (const GroupName& each : names) {
    known.push_back(each.name);
    if (each.name == group && (!found || each.dimension > found->dimension)) found = &each;
  }
  if (found) return found->tag;
  std::string list;
  for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
  throw BadInput(option + ": dist(" + group + "): the domain has no group of that name" +
                 did_you_mean(group, known) +
                 (known.empty() ? " (it has no named ones)" : " (it has: " + list + ")"));
}

}  // namespace pnpbs::tool
