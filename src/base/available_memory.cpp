// SPDX-License-Identifier: BSD-3-Clause
// The files are described in proc(5) and in the kernel's
// Documentation/admin-guide/cgroup-v1/memory.rst and cgroup-v2.rst.
#include "base/available_memory.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>

namespace pnpbs {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

// Returns the number at the beginning of a file, or kUnknown if the file begins with none ("max"
// means no limit).
double number_in(const std::string& path) {
  std::ifstream file(path);
  double value;
  return file >> value ? value : kUnknown;
}

// Returns the number that follows `word` at the beginning of a line, or kUnknown if no line begins
// so.
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

// Returns the number of bytes that a control group may still allocate. The usage of a group
// includes cached files, but the kernel drops these when memory is short.
double left_in_group(const std::string& folder, const GroupFiles& files) {
  const double limit = number_in(folder + files.limit);
  const double usage = number_in(folder + files.usage);
  const double cache = number_after(folder + "/memory.stat", files.cache);
  if (limit == kUnknown || usage == kUnknown) return kUnknown;
  return std::max(0.0, limit - usage + (cache == kUnknown ? 0 : cache));
}

// Returns the smallest allowance of the group and of all groups that contain it. A container may
// see the path of its group as it is outside, where no such folder exists below its own mount. The
// mount itself is its group then.
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
  // Version 2 has a line "0::/path". Version 1 has lines "5:memory:/path", whose second field may
  // list several controllers.
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

// /proc is read first because the maximum of getrusage(2) includes the memory of the program that
// started this process.
std::int64_t peak_memory() {
  const double kibibytes = number_after("/proc/self/status", "VmHWM:");
  if (kibibytes != kUnknown) return 1024 * static_cast<std::int64_t>(kibibytes);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<std::int64_t>(usage.ru_maxrss);  // KiB on Linux
}

}  // namespace pnpbs
