// SPDX-License-Identifier: BSD-3-Clause
#include "tool/file_format.hpp"

#include <algorithm>

#include "base/extension.hpp"
#include "base/small_letters.hpp"
#include "tool/library.hpp"

namespace pnpbs::tool {
namespace {

std::vector<FileFormat> all_formats() {
  std::vector<FileFormat> formats;
  for (const LibraryFormat& format : library_formats())
    formats.push_back({format.name, format.help, format.binary, format.elements, nullptr});
  for (const picture::Format& format : picture::formats())
    formats.push_back(
        {std::string(format.name), std::string(format.help), format.binary, false, &format});
  return formats;
}

}  // namespace

const std::vector<FileFormat>& file_formats() {
  static const std::vector<FileFormat> formats = all_formats();
  return formats;
}

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const FileFormat& format : file_formats()) names.push_back(format.name);
  return names;
}

std::string list_of_formats() {
  std::string list;
  for (const std::string& name : format_names()) list += (list.empty() ? "" : ", ") + name;
  return list;
}

const FileFormat* format_by_name(const std::string& name) {
  const auto& formats = file_formats();
  const auto found = std::ranges::find(formats, to_lower_case(name), &FileFormat::name);
  return found == formats.end() ? nullptr : &*found;
}

const FileFormat* format_by_extension(const std::string& path) {
  return format_by_name(extension_of(path));
}

}  // namespace pnpbs::tool
