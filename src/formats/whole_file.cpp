// SPDX-License-Identifier: BSD-3-Clause
#include "formats/whole_file.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>

#include "base/error.hpp"

namespace pnpbs {

std::string read_whole_file(const std::string& path) {
  const auto fail = [&path](const std::string& why) {
    throw Error(ErrorKind::file, path + ": cannot be read: " + why);
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) fail(std::strerror(errno));
  std::error_code ignored;
  const bool is_device = std::filesystem::is_character_file(path, ignored);
  std::string bytes;
  std::array<char, 65536> part;
  while (const std::size_t count = std::fread(part.data(), 1, part.size(), file.get())) {
    bytes.append(part.data(), count);
    // A device that gives zeros may never end.
    if (is_device && std::memchr(part.data(), 0, count) != nullptr) break;
  }
  if (std::ferror(file.get())) fail(std::strerror(errno));
  return bytes;
}

}  // namespace pnpbs
