// SPDX-License-Identifier: BSD-3-Clause
// Reader of scattered points in a table. The header has the names of the columns, of which x, y and
// z are coordinates. Each further line is a point. Columns are separated by commas or, where the
// header has none, by semicolons or tabs. ParaView's names of coordinates, Points:0 to Points:2,
// are accepted as well.
#include <algorithm>
#include <array>
#include <limits>

#include "base/error.hpp"
#include "base/limits.hpp"
#include "formats/text_fields.hpp"
#include "spacing/files/field_file.hpp"

namespace pnpbs {

namespace {

// Returns a cell without blanks and quotes around it.
std::string_view bare(std::string_view cell) {
  constexpr std::string_view kBlanks = " \t\r";
  const auto trim = [&] {
    cell.remove_prefix(std::min(cell.find_first_not_of(kBlanks), cell.size()));
    cell = cell.substr(0, cell.find_last_not_of(kBlanks) + 1);
  };
  trim();
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') {
    cell = cell.substr(1, cell.size() - 2);
    trim();
  }
  return cell;
}

// Splits the lines of a table into cells.
class Table {
 public:
  Table(std::string_view text, const std::string& name)
      : lines_(text, name, Comments::whole_lines) {
    expect_text(text, name, "CSV");
  }

  bool next_line(std::vector<std::string_view>& cells) {
    if (!lines_.next_line()) return false;
    std::string_view line = lines_.rest_of_line();
    if (separator_ == '\0')
      for (const char c : {'\t', ';', ','})
        if (line.find(c) != std::string_view::npos) separator_ = c;
    cells.clear();
    while (true) {
      const std::size_t end = std::min(line.find(separator_), line.size());
      cells.push_back(bare(line.substr(0, end)));
      if (end == line.size()) return true;
      line.remove_prefix(end + 1);
    }
  }

  const TextFields& lines() const { return lines_; }

 private:
  TextFields lines_;
  char separator_ = '\0';
};

// Returns the coordinate that a column contains, or -1.
int coordinate_of(std::string_view name) {
  constexpr std::array<std::array<std::string_view, 3>, 3> kNames{
      {{"x", "X", "Points:0"}, {"y", "Y", "Points:1"}, {"z", "Z", "Points:2"}}};
  for (std::size_t k = 0; k < 3; ++k)
    if (std::ranges::find(kNames[k], name) != kNames[k].end()) return static_cast<int>(k);
  return -1;
}

double number_in(std::string_view cell, const std::string& column, const TextFields& lines) {
  double value = 0;
  if (!parse_field(cell, value)) lines.fail_found(cell, column + ", a number");
  return value;
}

}  // namespace

FileField parse_csv_field(std::string_view text, const std::string& name,
                          const std::string& wanted) {
  Table table(text, name);
  std::vector<std::string_view> cells;
  if (!table.next_line(cells)) table.lines().fail("the file ends, expected a header: x,y,spacing");
  std::array<std::size_t, 3> columns;
  columns.fill(cells.size());
  std::vector<FieldName> fields;
  std::vector<std::size_t> field_columns;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const int k = coordinate_of(cells[c]);
    if (k >= 0) {
      if (columns[static_cast<std::size_t>(k)] < cells.size())
        table.lines().fail("two columns are called " + shown_field(cells[c]));
      columns[static_cast<std::size_t>(k)] = c;
    } else {
      fields.push_back({std::string(cells[c])});
      field_columns.push_back(c);
    }
  }
  const std::size_t count = cells.size();
  if (columns[0] == count || columns[1] == count)
    table.lines().fail_found(cells[0], "a header with columns x and y, as in 'x,y,spacing'");
  FileField file;
  const std::size_t field = chosen_field(fields, wanted, name);
  file.field = fields[field].name;
  const std::size_t value_column = field_columns[field];
  while (table.next_line(cells)) {
    if (cells.size() != count)
      table.lines().fail("found " + std::to_string(cells.size()) + " columns, expected " +
                         std::to_string(count) + " as in the header");
    Point<3> x{};
    for (std::size_t k = 0; k < 3; ++k)
      if (columns[k] < count)
        x[k] = number_in(cells[columns[k]], std::string(1, "xyz"[k]), table.lines());
    file.points.push_back(x);
    file.values.push_back(number_in(cells[value_column], file.field, table.lines()));
  }
  file.has_z = columns[2] < count;
  if (file.points.size() >= std::numeric_limits<std::int32_t>::max())
    table.lines().fail("more than 2147483646 points");
  return file;
}

}  // namespace pnpbs
