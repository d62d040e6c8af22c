// SPDX-License-Identifier: BSD-3-Clause
#include "tool/spacing_hints.hpp"

#include <cctype>
#include <fstream>
#include <iterator>

#include "base/text_lines.hpp"
#include "sphere/degrees.hpp"
#include "tool/exit.hpp"
#include "tool/numbers.hpp"

namespace pnpbs::tool {

namespace {

bool is_header(const std::string& line) {
  return std::isalpha(static_cast<unsigned char>(line[0])) != 0 || line[0] == '"';
}

}  // namespace

std::vector<double> read_spacing_hints(const std::string& path, int dimension, bool on_sphere) {
  std::ifstream file(path);
  if (!file) throw BadInput("--spacing-hints: cannot read '" + path + "'");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  const std::size_t columns = on_sphere ? 2 : static_cast<std::size_t>(dimension);
  std::vector<double> coordinates;
  std::string_view rest = text;
  for (std::int64_t number = 1; !rest.empty(); ++number) {
    std::string line(take_line(rest));
    while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back())) != 0)
      line.pop_back();
    if (line.empty() || line[0] == '#' || (number == 1 && is_header(line))) continue;
    const auto numbers = numbers_between_commas(line);
    if (!numbers || numbers->size() != columns)
      throw BadInput(path + ":" + std::to_string(number) + ": expected " +
                     (on_sphere        ? "a longitude and a latitude"
                      : dimension == 2 ? "x and y"
                                       : "x, y and z") +
                     ", separated by commas, found '" + line + "'");
    if (on_sphere) {
      const Point<3> direction = direction_at({(*numbers)[0], (*numbers)[1]});
      coordinates.insert(coordinates.end(), direction.begin(), direction.end());
    } else {
      coordinates.insert(coordinates.end(), numbers->begin(), numbers->end());
    }
  }
  return coordinates;
}

}  // namespace pnpbs::tool
