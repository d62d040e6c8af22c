// SPDX-License-Identifier: BSD-3-Clause
// What is found in a formula by its text alone, before muParser reads it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tool/library.hpp"

namespace pnpbs::tool {

// What an option was given.
struct FormulaSource {
  const std::string& option;
  const std::string& text;
};

// Throws BadInput with the text on one line, and below it a mark under the byte at `position`.
[[noreturn]] void fail_at(const FormulaSource& source, std::size_t position,
                          const std::string& what);

// muParser would assign to variables, and return the last of several values.
void refuse_what_is_no_formula(const FormulaSource& source);
void refuse_other_hypots(const FormulaSource& source);

// Does the formula have this name in it?
bool mentions(const std::string& formula, const std::string& name);
// All calls of a function, with their arguments, such as "gap(3)".
std::vector<std::string> calls_of(const std::string& function, const std::string& formula);

// A group that dist(NAME) asks for, and its tag as soon as there is a domain.
struct NamedGroup {
  std::string name, identifier;  // the name in the formula's letters
  double tag = 1;
};

// Groups in dist(NAME) and dist('NAME'); quotes, and what is no letter between them, become
// underscores in the text, so that places in it stay where they are.
std::vector<NamedGroup> groups_in(std::string& text);

// Of curves or surfaces before nodes. Throws BadInput with the names that there are, for the option
// that the formula was given by.
double tag_of_group(const std::string& group, const std::vector<GroupName>& names,
                    const std::string& option);

}  // namespace pnpbs::tool
