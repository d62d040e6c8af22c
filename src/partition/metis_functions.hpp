// SPDX-License-Identifier: BSD-3-Clause
// METIS, of which this process may hold another: a program linked with its own, perhaps with
// integers of another width, exports the same names, and the dynamic linker would give us those.
#pragma once

#include "base/build_config.hpp"

#if PNPBS_HAVE_MPI
#include <metis.h>

namespace pnpbs {

struct MetisFunctions {
  decltype(&METIS_SetDefaultOptions) set_default_options;
  decltype(&METIS_PartGraphRecursive) part_graph_recursive;
  decltype(&METIS_PartGraphKway) part_graph_kway;
};

// Those of the METIS that PNPBS was built with: linked into the library where that one is static,
// otherwise opened here, once, with names that nobody else sees and that nobody else's replace.
// Throws where it cannot be opened.
const MetisFunctions& metis();

}  // namespace pnpbs
#endif
