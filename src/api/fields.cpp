// SPDX-License-Identifier: BSD-3-Clause
// C interface: operations on values of a solver at the nodes.
#include "api/placement_calls.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

pnpbs_status pnpbs_placement_update_ghosts(pnpbs_placement placement, int64_t n, int32_t components,
                                           double* values) {
  return collective(placement, [&](Placement& p) {
    p.results().begin_ghost_update(n, components, values);
    p.results().end_ghost_update(n, components, values);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_begin_update_ghosts(pnpbs_placement placement, int64_t n,
                                                 int32_t components, const double* values) {
  return local_change(placement, [&](Placement& p) {
    p.results().begin_ghost_update(n, components, values);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_end_update_ghosts(pnpbs_placement placement, int64_t n,
                                               int32_t components, double* values) {
  return local_change(placement, [&](Placement& p) {
    p.results().end_ghost_update(n, components, values);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_add_from_ghosts(pnpbs_placement placement, int64_t n,
                                             int32_t components, double* values) {
  return collective(placement, [&](Placement& p) {
    p.results().add_from_ghosts(n, components, values);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_sum(pnpbs_placement placement, int64_t n, int32_t components,
                                 const double* values, double* sums) {
  return local_change(placement, [&](Placement& p) {
    p.results().sum(n, components, values, sums);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_dot(pnpbs_placement placement, int64_t n, int32_t components,
                                 const double* x, const double* y, double* products) {
  return local_change(placement, [&](Placement& p) {
    p.results().dot(n, components, x, y, products);
    return PNPBS_OK;
  });
}
