// SPDX-License-Identifier: BSD-3-Clause
#include "io/abandoned_files.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>
#include <string_view>
#include <system_error>

#include "base/mixed_hash.hpp"

namespace pnpbs::io {
namespace {

std::uint64_t hash_of(std::string_view text, std::uint64_t hash = 0) {
  for (const char letter : text) hash = mixed(hash ^ static_cast<unsigned char>(letter));
  return mixed(hash ^ text.size());
}

// Where numbers of processes mean the same: this machine, since it was started, and this container.
std::uint64_t process_space() {
  char host[256] = "";
  ::gethostname(host, sizeof host - 1);
  std::string start;
  std::getline(std::ifstream("/proc/sys/kernel/random/boot_id"), start);
  std::error_code none;
  const std::string container = std::filesystem::read_symlink("/proc/self/ns/pid", none).string();
  return hash_of(container, hash_of(start, hash_of(host)));
}

// What names for this target begin with; behind it come process and a number at random.
std::string prefix_of(const std::filesystem::path& target) {
  static const std::uint64_t space = process_space();
  return ".pnpbs-" + std::to_string(hash_of(target.filename().string(), space)) + "-";
}

// A number that nobody has is one of a process that has ended.
bool has_ended(std::string_view rest_of_name) {
  pid_t process = 0;
  const char* const end = rest_of_name.data() + rest_of_name.size();
  const auto read = std::from_chars(rest_of_name.data(), end, process);
  if (read.ec != std::errc() || read.ptr == end || *read.ptr != '-' || process <= 0) return false;
  return ::kill(process, 0) != 0 && errno == ESRCH;
}

}  // namespace

std::string unfinished_name_beside(const std::string& target) {
  static std::random_device random;
  const std::filesystem::path path(target);
  return (path.parent_path() /
          (prefix_of(path) + std::to_string(::getpid()) + "-" + std::to_string(random())))
      .string();
}

// By calls of the system: the iterators of std::filesystem end the process where memory is lacking.
void remove_abandoned_beside(const std::string& target) noexcept {
  DIR* folder = nullptr;
  try {
    const std::filesystem::path path(target);
    const std::string prefix = prefix_of(path);
    const std::string parent = path.parent_path().string();
    folder = ::opendir(parent.empty() ? "." : parent.c_str());
    if (!folder) return;
    while (const dirent* entry = ::readdir(folder)) {
      const std::string_view name = entry->d_name;
      if (name.starts_with(prefix) && has_ended(name.substr(prefix.size())))
        ::unlinkat(::dirfd(folder), entry->d_name, 0);
    }
  } catch (...) {
    // They may stay; the new file counts.
  }
  if (folder) ::closedir(folder);
}

}  // namespace pnpbs::io
