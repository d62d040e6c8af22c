// SPDX-License-Identifier: BSD-3-Clause
// A stand-in for a METIS whose integers are twice or half as wide as those that PNPBS is built
// with. It has only the functions by which the library checks the width.
#include <metis.h>

#include <cstdint>
#include <type_traits>

using OtherInteger =
    std::conditional_t<sizeof(idx_t) == sizeof(std::int32_t), std::int64_t, std::int32_t>;

extern "C" int METIS_SetDefaultOptions(idx_t* options) {
  auto* others = reinterpret_cast<OtherInteger*>(options);
  for (int k = 0; k < METIS_NOPTIONS; ++k) others[k] = -1;
  return METIS_OK;
}
extern "C" int METIS_PartGraphRecursive(idx_t*, idx_t*, idx_t*, idx_t*, idx_t*, idx_t*, idx_t*,
                                        idx_t*, real_t*, real_t*, idx_t*, idx_t*, idx_t*) {
  return METIS_ERROR;
}
extern "C" int METIS_PartGraphKway(idx_t*, idx_t*, idx_t*, idx_t*, idx_t*, idx_t*, idx_t*, idx_t*,
                                   real_t*, real_t*, idx_t*, idx_t*, idx_t*) {
  return METIS_ERROR;
}
