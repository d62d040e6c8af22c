// SPDX-License-Identifier: BSD-3-Clause
// C interface: the elements that are incident to the own nodes of a rank.
#include "results/incident_elements.hpp"

#include <algorithm>

#include "api/placement_calls.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

namespace {

template <std::size_t Corners, int Dim>
pnpbs_status copy_elements(const Results<Dim>& in, std::int64_t capacity, std::int64_t* count,
                           std::int32_t* corners, std::int64_t* elements) {
  *count = count_incident_elements<Corners>(in);
  if (corners) *corners = static_cast<std::int32_t>(Corners);
  if (capacity == 0 && !elements) return PNPBS_OK;
  require_capacity(capacity, *count);
  if (!elements) return PNPBS_OK;
  for (const auto& places : incident_elements<Corners>(in))
    elements = std::copy(places.begin(), places.end(), elements);
  return PNPBS_OK;
}

}  // namespace

pnpbs_status pnpbs_placement_get_incident_elements(pnpbs_placement placement, int64_t capacity,
                                                   int64_t* count, int32_t* corners,
                                                   int64_t* elements) {
  return collective_results(placement, [&](NodalResults& results) {
    require_pointer(count, "count");
    results.prepare_stars();
    if (results.dimension() == 2)
      return copy_elements<3>(require_dimension<2>(results), capacity, count, corners, elements);
    const Results<3>& in = require_dimension<3>(results);
    return in.kind() == GeometryKind::surface
               ? copy_elements<3>(in, capacity, count, corners, elements)
               : copy_elements<4>(in, capacity, count, corners, elements);
  });
}
