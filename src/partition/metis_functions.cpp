// SPDX-License-Identifier: BSD-3-Clause
#include "partition/metis_functions.hpp"

#if PNPBS_HAVE_MPI
#ifdef PNPBS_METIS_PATH
#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <string>

#include "base/error.hpp"
#include "base/opened_library.hpp"
#endif

namespace pnpbs {

#ifdef PNPBS_METIS_PATH

namespace {

// Opens METIS. The path comes first, because the name alone could resolve to another METIS of the
// host program.
void* open_metis() {
  if (void* library = open_library({PNPBS_METIS_PATH, PNPBS_METIS_NAME})) return library;
  const char* reason = dlerror();
  throw Error(ErrorKind::unsupported,
              std::string("METIS, which distributes nodes over ranks, cannot be opened: neither "
                          "\"" PNPBS_METIS_PATH "\" nor \"" PNPBS_METIS_NAME "\" (") +
                  (reason ? reason : "no reason given") +
                  "): install it, or add its folder to LD_LIBRARY_PATH");
}

template <class Function>
void look_up(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  if (!function)
    throw Error(ErrorKind::unsupported, std::string("the METIS that was opened has no ") + name +
                                            ": PNPBS was built with \"" PNPBS_METIS_PATH "\"");
}

// Throws if the opened METIS has integers of another width. METIS writes a fixed number of options,
// so with another width it overwrites more or fewer of our entries.
void require_our_width(const MetisFunctions& functions) {
  constexpr idx_t kUntouched = 12345;
  std::array<idx_t, 2 * METIS_NOPTIONS> options;
  options.fill(kUntouched);
  functions.set_default_options(options.data());
  if (std::count(options.begin(), options.end(), kUntouched) == METIS_NOPTIONS) return;
  throw Error(ErrorKind::unsupported,
              "the METIS that was opened has integers of another width than the " +
                  std::to_string(IDXTYPEWIDTH) +
                  " bits of \"" PNPBS_METIS_PATH
                  "\", which PNPBS was built with: install that one");
}

MetisFunctions opened_functions() {
  void* library = open_metis();
  MetisFunctions functions{};
  look_up(library, "METIS_SetDefaultOptions", functions.set_default_options);
  look_up(library, "METIS_PartGraphRecursive", functions.part_graph_recursive);
  look_up(library, "METIS_PartGraphKway", functions.part_graph_kway);
  require_our_width(functions);
  return functions;
}

}  // namespace

const MetisFunctions& metis() {
  static const MetisFunctions functions = opened_functions();
  return functions;
}

#else

const MetisFunctions& metis() {
  static const MetisFunctions functions{METIS_SetDefaultOptions, METIS_PartGraphRecursive,
                                        METIS_PartGraphKway};
  return functions;
}

#endif

}  // namespace pnpbs
#endif
