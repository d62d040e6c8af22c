// SPDX-License-Identifier: BSD-3-Clause
#include "tool/level_set.hpp"

#include <filesystem>
#include <utility>

#include "tool/exit.hpp"
#include "tool/numbers.hpp"

namespace pnpbs::tool {
namespace {

constexpr std::size_t numbers_before_formula = 7;

// Behind so many commas; npos if there are fewer.
std::size_t behind_commas(const std::string& text, std::size_t commas) {
  std::size_t at = 0;
  for (std::size_t k = 0; k < commas; ++k) {
    const std::size_t comma = text.find(',', at);
    if (comma == std::string::npos) return comma;
    at = comma + 1;
  }
  return at;
}

}  // namespace

std::unique_ptr<LevelSet> LevelSet::in(const std::string& text) {
  const std::string name = "levelset(";
  std::error_code error;
  if (!text.starts_with(name) || std::filesystem::exists(text, error)) return nullptr;
  const bool whole = text.ends_with(')');
  const std::string inner = text.substr(name.size(), text.size() - name.size() - (whole ? 1 : 0));
  const std::size_t formula = behind_commas(inner, numbers_before_formula);
  const auto numbers =
      numbers_between_commas(formula == std::string::npos ? inner : inner.substr(0, formula - 1));
  if (!whole || formula == std::string::npos || !numbers)
    throw BadInput(
        "--domain: '" + text +
        "' is not levelset(x0,y0,z0, x1,y1,z1, h, f), two opposite corners of a box, the "
        "resolution, and a formula in x, y and z that is negative inside the body");
  return std::unique_ptr<LevelSet>(new LevelSet(*numbers, inner.substr(formula)));
}

LevelSet::LevelSet(std::vector<double> numbers, const std::string& formula)
    : numbers_(std::move(numbers)), f_(formula, 3, "--domain") {}

void LevelSet::add_to(pnpbs_domain domain, pnpbs_context context) const {
  constexpr std::int32_t tag = 1;
  const double* x = numbers_.data();
  check(pnpbs_domain_add_level_set(domain, call_expression, f_.as_user(), x, x + 3, x[6], tag),
        context);
}

}  // namespace pnpbs::tool
