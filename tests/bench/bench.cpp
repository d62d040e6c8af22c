// SPDX-License-Identifier: BSD-3-Clause
// pnpbs-bench: places nodes in the benchmark cases and evaluates them. Usage:
//   pnpbs-bench [--data DIR] [--scale S] [--nodes N] [--set key=value]... [--repeat N] [--no-judge]
//               [CASE...]
// S multiplies every spacing (0.3162 gives ten times the nodes in the plane). N is the approximate
// number of nodes in each case in space. Speed is the median of the repetitions, and so is the user
// time of the process, which is less sensitive to other work on the machine.
//
// The evaluation uses another library. In the plane: quality of the triangles where the domain is
// wider than 3 d, then of all; edge length over d by bands of d ("?": fewer than 100 edges), at the
// boundary, and where its mean over two rings of neighbours is smallest and largest. In space:
// quality and dihedral angles of all tetrahedra, of those inside and of those at the boundary, with
// the location of the smallest angle; edge length over d of all edges and by the number of ends on
// the boundary, by octaves of d, and at the worst locations; the triangles of the boundary.
//
// A CASE that ends with "-" selects all cases with this prefix: bands- for the study of the bands
// of d, volume- for the cases in space.
#include <cstdio>
#include <cstdlib>

#include "bench_plane.hpp"
#include "bench_volumes.hpp"

namespace {

pnpbs_bench::Arguments read(int argc, char** argv) {
  pnpbs_bench::Arguments arguments;
  for (int a = 1; a < argc; ++a) {
    const std::string arg = argv[a];
    const char* const value = a + 1 < argc ? argv[a + 1] : "";
    if (arg == "--no-judge") {
      arguments.judge = false;
    } else if (arg.rfind("--", 0) != 0) {
      arguments.names.push_back(arg);
    } else {
      const std::string pair = value;
      const std::size_t equals = pair.find('=');
      ++a;
      if (arg == "--data" && !pair.empty()) {
        arguments.data = pair;
      } else if (arg == "--scale" && std::atof(value) > 0) {
        arguments.scale = std::atof(value);
      } else if (arg == "--nodes" && std::atof(value) >= 100) {
        arguments.nodes = std::atof(value);
      } else if (arg == "--repeat" && std::atoi(value) >= 1) {
        arguments.repeat = std::atoi(value);
      } else if (arg == "--set" && equals != std::string::npos) {
        arguments.options.emplace_back(pair.substr(0, equals), pair.substr(equals + 1));
      } else {
        std::fprintf(stderr,
                     "usage: %s [--data DIR] [--scale S] [--nodes N] [--set key=value]... "
                     "[--repeat N] [--no-judge] [CASE...]\n",
                     argv[0]);
        std::exit(2);
      }
    }
  }
  return arguments;
}

}  // namespace

int main(int argc, char** argv) {
  const pnpbs_bench::Arguments arguments = read(argc, argv);
  pnpbs_bench::bench_plane(arguments);
  pnpbs_bench::bench_volumes(arguments);
  pnpbs_context context = pnpbs_bench::bench_context();
  pnpbs_context_destroy(&context);
  return 0;
}
