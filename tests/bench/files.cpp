// SPDX-License-Identifier: BSD-3-Clause
// pnpbs-bench-files: places nodes in a square, or in a cube with --space, and writes them in each
// available format separately. Prints seconds of the wall clock and of the processor, and megabytes
// for each. Usage:
//   pnpbs-bench-files [--nodes N] [--space] [--folder DIR]
// N: approximate number of nodes, a million by default. DIR: where a folder is created and removed.
#include <pnpbs/pnpbs.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <string>

namespace {

struct Arguments {
  double nodes = 1e6;
  bool space = false;
  std::string folder = std::filesystem::temp_directory_path().string();
};

Arguments read(int argc, char** argv) {
  Arguments arguments;
  for (int a = 1; a < argc; ++a) {
    const std::string arg = argv[a];
    if (arg == "--space") {
      arguments.space = true;
    } else if (arg == "--nodes" && a + 1 < argc && std::atof(argv[a + 1]) >= 100) {
      arguments.nodes = std::atof(argv[++a]);
    } else if (arg == "--folder" && a + 1 < argc) {
      arguments.folder = argv[++a];
    } else {
      std::fprintf(stderr, "usage: %s [--nodes N] [--space] [--folder DIR]\n", argv[0]);
      std::exit(2);
    }
  }
  return arguments;
}

void must(pnpbs_status status) {
  if (status >= 0) return;
  std::fprintf(stderr, "%s\n", pnpbs_last_error(nullptr));
  std::exit(1);
}

// Places nodes with a few steps only, as their quality does not affect the files.
pnpbs_placement placed(pnpbs_context context, const Arguments& arguments) {
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1}, low[] = {0, 0, 0}, high[] = {1, 1, 1};
  pnpbs_domain domain;
  pnpbs_placement placement;
  must(pnpbs_domain_create(context, arguments.space ? 3 : 2, &domain));
  must(arguments.space
           ? pnpbs_domain_add_box(domain, low, high, 1)
           : pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square, nullptr, 1));
  must(pnpbs_placement_create(context, domain, &placement));
  must(pnpbs_domain_destroy(&domain));
  const double d = arguments.space ? std::cbrt(std::sqrt(2.0) / arguments.nodes)
                                   : std::sqrt(2 / std::sqrt(3.0) / arguments.nodes);
  must(pnpbs_placement_set_spacing_constant(placement, d));
  must(pnpbs_placement_set_int64(placement, "steps", 4));
  must(pnpbs_placement_set_int64(placement, "sweeps", 0));
  must(pnpbs_placement_run(placement));
  return placement;
}

double megabytes_in(const std::filesystem::path& folder) {
  double bytes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    bytes += static_cast<double>(entry.file_size());
    std::filesystem::remove(entry.path());
  }
  return bytes / 1e6;
}

void write_every_format(pnpbs_placement placement, const std::filesystem::path& folder) {
  using Clock = std::chrono::steady_clock;
  std::int32_t count = 0;
  must(pnpbs_format_count(&count));
  std::printf("%-8s %9s %9s %9s\n", "format", "seconds", "cpu", "MB");
  for (std::int32_t k = 0; k < count; ++k) {
    const char* name = nullptr;
    must(pnpbs_format_info(k, &name, nullptr, nullptr, nullptr));
    const std::string path = (folder / (std::string("a.") + name)).string();
    const auto begin = Clock::now();
    const std::clock_t cpu = std::clock();
    const pnpbs_status status =
        pnpbs_placement_write(placement, path.c_str(), std::strcmp(name, "csv") != 0);
    if (status < 0) {
      std::printf("%-8s %s\n", name, pnpbs_last_error(nullptr));
      continue;
    }
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    std::printf("%-8s %9.2f %9.2f %9.1f\n", name, seconds,
                static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC, megabytes_in(folder));
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments = read(argc, argv);
  std::string folder = arguments.folder + "/pnpbs-bench-files-XXXXXX";
  if (!mkdtemp(folder.data())) {
    std::perror(folder.c_str());
    return 1;
  }
  pnpbs_context context;
  must(pnpbs_context_create_serial(&context));
  pnpbs_placement placement = placed(context, arguments);
  std::int64_t nodes = 0;
  must(pnpbs_placement_get_int64(placement, "nodes", &nodes));
  std::printf("%lld nodes\n", static_cast<long long>(nodes));
  write_every_format(placement, folder);
  std::filesystem::remove_all(folder);
  must(pnpbs_placement_destroy(&placement));
  must(pnpbs_context_destroy(&context));
  return 0;
}
