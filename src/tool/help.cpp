// SPDX-License-Identifier: BSD-3-Clause
#include "tool/help.hpp"

#include <algorithm>
#include <sstream>

#include "tool/exit.hpp"
#include "tool/expression.hpp"
#include "tool/file_format.hpp"
#include "tool/geo_file.hpp"
#include "tool/library.hpp"

namespace pnpbs::tool {
namespace {

constexpr std::size_t page_width = 90;

// Wraps the words of `text` into lines that begin at column `indent`. The first line continues at
// the current column.
std::string wrapped(const std::string& text, std::size_t indent) {
  std::istringstream words(text);
  std::string result, word;
  std::size_t column = indent;
  while (words >> word) {
    if (column > indent && column + 1 + word.size() > page_width) {
      result += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (column > indent) {
      result += " ";
      ++column;
    }
    result += word;
    column += word.size();
  }
  return result + "\n";
}

std::string row(const std::string& name, std::size_t indent, const std::string& text) {
  std::string begin = "  " + name + " ";
  if (begin.size() < indent) {
    begin.resize(indent, ' ');
  } else {
    begin += "\n" + std::string(indent, ' ');
  }
  return begin + wrapped(text, indent);
}

std::string format_table() {
  std::string text = "\nFormats of --output:\n";
  for (const FileFormat& format : file_formats()) {
    text += row("." + format.name, 10, format.help);
  }
  return text;
}

std::string option_table() {
  std::string text = "\nOptions of the library, for --set:\n";
  for (const LibraryOption& option : library_options()) {
    text += row(option.name, 22,
                option.help + " (" + option.range + "; default " + option.default_value + ")");
  }
  return text;
}

}  // namespace

std::string help_tables() {
  return format_table() + "\nFormulas may have:\n  " + wrapped(expression_help(), 2) +
         option_table() +
         "\nExit codes: 0 done, 1 failed, 2 bad usage or input; 3 not converged, 4 somewhere the "
         "nodes do\nnot follow the spacing, 5 parts of a coast were left out, 6 the elements do "
         "not "
         "fill the\ndomain (files are written); 130 interrupted (no file is written but a "
         "checkpoint).\n";
}

std::string statistics_text() {
  std::string text;
  for (const LibraryStatistic& statistic : library_statistics()) {
    text += row(statistic.name, 26, statistic.help);
  }
  return text;
}

std::string version_text() {
  std::int32_t major = 0, minor = 0, patch = 0;
  check(pnpbs_version(&major, &minor, &patch), nullptr);
  std::string text = "pnpbs " + std::to_string(major) + "." + std::to_string(minor) + "." +
                     std::to_string(patch) + "\n" + pnpbs_build_info();
  if (!text.ends_with('\n')) text += '\n';
  try {
    return text + GeoLibrary().build_info();
  } catch (const Failure&) {
    return text + "GDAL: none: no GeoJSON, no shapefiles\n";
  }
}

}  // namespace pnpbs::tool
