// SPDX-License-Identifier: BSD-3-Clause
// Files: proc(5), and the kernel's Documentation/admin-guide/cgroup-v1/memory.rst and
// cgroup-v2.rst.
#include "base/available_memory.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>

namespace pnpbs {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

// The first number of a file; unknown if there is none ("max" means no limit).
double number_in(const std::string& path) {
  std::ifstream file(path);
  double value;
  return file >> value ? value : kUnknown;
}

// The number after a word at the beginning of a line.
double number_after(const std::string& path, const std::string& word) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream text(line);
    std::string first;
    double value;
    if (text >> first >> value && first == word) return value;
  }
  return kUnknown;
}

struct GroupFiles {
  const char *limit, *usage, *cache;
};
constexpr GroupFiles kVersion2{"/memory.max", "/memory.current", "inactive_file"};
constexpr GroupFiles kVersion1{"/memory.limit_in_bytes", "/memory.usage_in_bytes",
                               "total_inactive_file"};

// What a group may still take. Cached files count as used there, but are given back.
double left_in_group(const std::string& folder, const GroupFiles& files) {
  const double limit = number_in(folder + files.limit);
  const double usage = number_in(folder + files.usage);
  const double cache = number_after(folder + "/memory.stat", files.cache);
  if (limit == kUnknown || usage == kUnknown) return kUnknown;
  return std::max(0.0, limit - usage + (cache == kUnknown ? 0 : cache));
}

// Of the group and all that it is in. A container may see its group's path from outside, which is
// nowhere below its own mount: then the mount itself is the group.
double left_in_groups(const std::string& mount, std::string group, const GroupFiles& files) {
  double left = left_in_group(mount, files);
  while (group.size() > 1) {
    left = std::min(left, left_in_group(mount + group, files));
    group.resize(group.find_last_of('/'));
  }
  return left;
}

}  // namespace

double available_memory(const std::string& root) {
  constexpr double kKibibyte = 1024;
  double left = kKibibyte * number_after(root + "/proc/meminfo", "MemAvailable:");
  std::ifstream groups(root + "/proc/self/cgroup");
  // "0::/path" of version 2; "5:memory:/path" of version 1, where controllers are several.
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    const std::string path = line.substr(second + 1);
    if (controllers == ",,")
      left = std::min(left, left_in_groups(root + "/sys/fs/cgroup", path, kVersion2));
    if (controllers.find(",memory,") != std::string::npos)
      left = std::min(left, left_in_groups(root + "/sys/fs/cgroup/memory", path, kVersion1));
  }
  return left;
}

// What getrusage(2) tells begins with what the program held that started this one.
std::int64_t peak_memory() {
  const double kibibytes = number_after("/proc/self/status", "VmHWM:");
  if (kibibytes != kUnknown) return 1024 * static_cast<std::int64_t>(kibibytes);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<std::int64_t>(usage.ru_maxrss);  // KiB on Linux
}

}  // namespace pnpbs
