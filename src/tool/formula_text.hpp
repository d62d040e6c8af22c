// SPDX-License-Identifier: BSD-3-Clause
// Checks of the text of a formula before muParser parses it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tool/library.hpp"

namespace pnpbs::tool {

// An option and its value, a formula.
struct FormulaSource {
  const std::string& option;
  const std::string& text;
};

// Throws BadInput with the text on one line and a mark under the byte at `position`.
[[noreturn]] void fail_at(const FormulaSource& source, std::size_t position,
                          const std::string& what);

// Rejects assignments to variables and lists of several values, which muParser would accept.
void reject_invalid_formula(const FormulaSource& source);
void refuse_other_hypots(const FormulaSource& source);

// Returns whether the name occurs in the formula.
bool mentions(const std::string& formula, const std::string& name);
// Returns all calls of a function with their arguments, such as "gap(3)".
std::vector<std::string> calls_of(const std::string& function, const std::string& formula);

// A group in dist(NAME, ...), and its tag once the domain exists.
struct NamedGroup {
  std::string name, identifier;  // the identifier replaces the name in the formula
  double tag = 1;
};

// Finds the groups in dist(NAME), dist('NAME') and dist(NAME, TAG, ...). Quotes, and characters
// between them that are not letters, become underscores in the text, so that positions in it do not
// change.
std::vector<NamedGroup> groups_in(std::string& text);

// Returns the tag of a group of curves or surfaces. Throws BadInput with all known names if there
// is none; `option` is the option of the formula.
double tag_of_group(const std::string& group, const std::vector<GroupName>& names,
                    const std::string& option);

}  // namespace pnpbs::tool
