// SPDX-License-Identifier: BSD-3-Clause
// Tests of the available memory, with a folder of files in the format of /proc and /sys.
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/available_memory.hpp"
#include "geometry/run_suite.hpp"

namespace {

namespace fs = std::filesystem;

constexpr double kMebibyte = 1024 * 1024;

// A folder that replaces the root of the file system.
class System {
 public:
  System() : root_(fs::temp_directory_path() / ("pnpbs-memory-" + std::to_string(::getpid()))) {
    file("/proc/meminfo",
         "MemTotal:        8388608 kB\nMemFree:          102400 kB\nMemAvailable:    4096000 kB\n");
  }
  ~System() { fs::remove_all(root_); }

  void file(const std::string& path, const std::string& text) const {
    const fs::path whole = root_.string() + path;
    fs::create_directories(whole.parent_path());
    std::ofstream(whole) << text;
  }
  void group(const std::string& folder, const std::string& limit, double used, double cache) const {
    file(folder + "/memory.max", limit + "\n");
    file(folder + "/memory.current", std::to_string(static_cast<std::int64_t>(used)) + "\n");
    file(folder + "/memory.stat",
         "anon 1\ninactive_file " + std::to_string(static_cast<std::int64_t>(cache)) + "\n");
  }
  double available() const { return pnpbs::available_memory(root_.string()); }

 private:
  fs::path root_;
};

void expect(double found, double mebibytes) { ck_assert_double_eq(found, mebibytes * kMebibyte); }

}  // namespace

START_TEST(machine_alone) {
  const System system;
  expect(system.available(), 4000);
}
END_TEST

START_TEST(group_of_version_2) {
  const System system;
  system.file("/proc/self/cgroup", "0::/batch/job\n");
  system.group("/sys/fs/cgroup/batch/job", "max", 100 * kMebibyte, 0);
  expect(system.available(), 4000);
  // Limits of parent groups count, too. Memory of cached files counts as available.
  system.group("/sys/fs/cgroup/batch", "1073741824", 524 * kMebibyte, 100 * kMebibyte);
  expect(system.available(), 600);
  system.group("/sys/fs/cgroup/batch/job", "209715200", 100 * kMebibyte, 0);
  expect(system.available(), 100);
  system.group("/sys/fs/cgroup/batch/job", "104857600", 200 * kMebibyte, 0);
  expect(system.available(), 0);
}
END_TEST

// The path is that of the host, while the mount point is that of the container.
START_TEST(container_of_version_2) {
  const System system;
  system.file("/proc/self/cgroup", "0::/../../elsewhere\n");
  system.group("/sys/fs/cgroup", "1073741824", 24 * kMebibyte, 0);
  expect(system.available(), 1000);
}
END_TEST

START_TEST(group_of_version_1) {
  const System system;
  system.file("/proc/self/cgroup", "12:cpu,cpuacct:/a\n5:memory:/a\n1:name=systemd:/a\n");
  system.file("/sys/fs/cgroup/memory/a/memory.limit_in_bytes", "524288000\n");
  system.file("/sys/fs/cgroup/memory/a/memory.usage_in_bytes", "104857600\n");
  expect(system.available(), 400);
}
END_TEST

START_TEST(nothing_is_told) {
  ck_assert(pnpbs::available_memory("/nowhere-at-all") > 1e300);
  ck_assert(pnpbs::available_memory() > kMebibyte);  // memory of this machine
}
END_TEST

TEST_SUITE(test_available_memory) {
  return run_suite("available_memory", {machine_alone, group_of_version_2, container_of_version_2,
                                        group_of_version_1, nothing_is_told});
}
