// SPDX-License-Identifier: BSD-3-Clause
// C interface: elements whose nodes are doubled along cracks.
#include "results/cracks.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "api/placement_calls.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

namespace {

// Runs body(results, cracks) as a collective call.
template <class Body>
pnpbs_status with_cracks(pnpbs_placement placement, std::int64_t* count, const Body& body) {
  return collective_results(placement, [&](NodalResults& results) {
    require_pointer(count, "count");
    require_not_periodic(results, "there are no cracks");
    return visit_dimension(results, [&](auto& in) { return body(in, in.cracks()); });
  });
}

}  // namespace

pnpbs_status pnpbs_placement_set_cracks(pnpbs_placement placement, int32_t n, const int32_t* tags) {
  return local_change(placement, [&](Placement& p) {
    require_count(n, "n");
    if (n > 0) require_pointer(tags, "tags");
    const std::set<std::int32_t> distinct(tags, tags + n);
    if (distinct.contains(0))
      throw Error(ErrorKind::argument, "argument tags has a 0, which is no tag of a crack");
    p.results().set_crack_tags({distinct.begin(), distinct.end()});
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_crack_nodes(pnpbs_placement placement, int64_t capacity,
                                             int64_t* count, int64_t* all, int64_t* nodes,
                                             int64_t* numbers) {
  return with_cracks(placement, count, [&](const auto&, const auto& cracks) {
    *count = std::ssize(cracks.copies());
    if (all) *all = cracks.all();
    if (capacity == 0 && !nodes && !numbers) return PNPBS_OK;
    require_capacity(capacity, *count);
    for (const CrackCopy& copy : cracks.copies()) {
      if (nodes) *nodes++ = copy.node;
      if (numbers) *numbers++ = copy.number;
    }
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_cracked_elements(pnpbs_placement placement, int64_t capacity,
                                                  int64_t* count, int64_t* elements) {
  return with_cracks(placement, count, [&](const auto& results, const auto& cracks) {
    *count = 0;
    results.for_elements([&](const auto&) { ++*count; });
    if (capacity == 0 && !elements) return PNPBS_OK;
    require_capacity(capacity, *count);
    if (!elements) return PNPBS_OK;
    std::int64_t* next = elements;
    results.for_elements([&](const auto& places) {
      const auto copies = cracks.copies_in(places);
      for (std::size_t k = 0; k < places.size(); ++k)
        *next++ = copies[k] < 0 ? places[k] : results.held() + copies[k];
    });
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_crack_facets(pnpbs_placement placement, int64_t capacity,
                                              int64_t* count, double* covered, int64_t* front,
                                              int64_t* back, int32_t* tags) {
  return with_cracks(placement, count, [&](const auto& results, const auto& cracks) {
    *count = std::ranges::count_if(cracks.facets(), [](const auto& f) { return f.tag != 0; });
    if (covered) *covered = cracks.covered();
    if (capacity == 0 && !front && !back && !tags) return PNPBS_OK;
    require_capacity(capacity, *count);
    for (const auto& facet : cracks.facets()) {
      if (facet.tag == 0) continue;
      for (std::size_t k = 0; k < facet.places.size(); ++k) {
        const auto node_at = [&](std::size_t side) {
          const std::int64_t copy = facet.copies[side][k];
          return copy < 0 ? facet.places[k] : results.held() + copy;
        };
        if (front) *front++ = node_at(0);
        if (back) *back++ = node_at(1);
      }
      if (tags) *tags++ = facet.tag;
    }
    return PNPBS_OK;
  });
}
