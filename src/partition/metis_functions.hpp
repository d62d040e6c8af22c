// SPDX-License-Identifier: BSD-3-Clause
// Access to the METIS that PNPBS was built with. The host program may be linked with another METIS,
// perhaps with integers of another width. It exports the same names, and the dynamic linker would
// resolve our calls to it.
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

// Returns the functions of METIS. A static METIS is linked into the library. A shared one is opened
// at the first call, with local symbols, so that neither side sees the other's. Throws if it cannot
// be opened.
const MetisFunctions& metis();

}  // namespace pnpbs
#endif
