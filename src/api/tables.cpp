// SPDX-License-Identifier: BSD-3-Clause
// C interface: the tables of options, statistics and file formats.
#include "api/guard.hpp"
#include "io/formats.hpp"
#include "placement/statistics.hpp"
#include "settings/options.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

namespace {

template <class Table>
const auto& row_at(const Table& table, int32_t index) {
  if (index < 0 || static_cast<std::size_t>(index) >= table.size())
    throw Error(ErrorKind::argument, "argument index = " + std::to_string(index) +
                                         " is not in 0 .. " + std::to_string(table.size() - 1));
  return table[static_cast<std::size_t>(index)];
}

const std::vector<std::string>& option_ranges() {
  static const std::vector<std::string> ranges = [] {
    std::vector<std::string> texts;
    for (const OptionRow& row : option_table()) texts.push_back(row.range());
    return texts;
  }();
  return ranges;
}

void give(const char** output, const char* text) {
  if (output) *output = text;
}

}  // namespace

pnpbs_status pnpbs_option_count(int32_t* count) {
  return guarded([&] {
    require_pointer(count, "count");
    *count = static_cast<int32_t>(option_table().size());
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_option_info(int32_t index, const char** name, const char** type,
                               const char** default_value, const char** range, const char** help) {
  return guarded([&] {
    const OptionRow& row = row_at(option_table(), index);
    const char* types[] = {"integer", "real", "choice"};
    give(name, row.name);
    give(type, types[static_cast<int>(row.type)]);
    give(default_value, row.default_value);
    give(range, option_ranges()[static_cast<std::size_t>(index)].c_str());
    give(help, row.help);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_statistic_count(int32_t* count) {
  return guarded([&] {
    require_pointer(count, "count");
    *count = static_cast<int32_t>(statistic_table().size());
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_statistic_info(int32_t index, const char** name, const char** type,
                                  const char** help) {
  return guarded([&] {
    const StatisticRow& row = row_at(statistic_table(), index);
    give(name, row.name);
    give(type, row.type());
    give(help, row.help);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_format_count(int32_t* count) {
  return guarded([&] {
    require_pointer(count, "count");
    *count = static_cast<int32_t>(io::formats().size());
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_format_info(int32_t index, const char** name, const char** help, int32_t* binary,
                               int32_t* elements) {
  return guarded([&] {
    const io::Format& format = row_at(io::formats(), index);
    give(name, format.name);
    give(help, format.help);
    if (binary) *binary = format.binary;
    if (elements)
      *elements =
          format.elements == io::Elements::on_request || format.elements == io::Elements::grid;
    return PNPBS_OK;
  });
}
