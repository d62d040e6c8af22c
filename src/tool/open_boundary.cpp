// SPDX-License-Identifier: BSD-3-Clause
#include "tool/open_boundary.hpp"

#include <algorithm>
#include <vector>

namespace pnpbs::tool {
namespace {

// A callback that is negative where the formula `user` is greater than 0.
std::int32_t call_negated(std::int64_t n, std::int32_t dim, const double* coordinates,
                          double* values, void* user) {
  const std::int32_t status = call_expression(n, dim, coordinates, values, user);
  std::transform(values, values + n, values, [](double value) { return -value; });
  return status;
}

std::int32_t new_tag(pnpbs_domain domain, pnpbs_context context) {
  std::int64_t count = 0;
  check(pnpbs_domain_get_segments(domain, 0, &count, nullptr, nullptr), context);
  std::vector<std::int32_t> tags(static_cast<std::size_t>(count));
  check(pnpbs_domain_get_segments(domain, count, &count, nullptr, tags.data()), context);
  for (const GroupName& group : group_names(domain, context))
    if (group.dimension == 1) tags.push_back(group.tag);
  return tags.empty() ? 1 : std::max(0, *std::ranges::max_element(tags)) + 1;
}

// Returns the tag of open boundaries, which has a name then.
std::int32_t tag_of_open(pnpbs_domain domain, pnpbs_context context) {
  for (const GroupName& group : group_names(domain, context))
    if (group.dimension == 1 && group.name.starts_with("open")) return group.tag;
  const std::int32_t tag = new_tag(domain, context);
  check(pnpbs_domain_set_tag_name(domain, 1, tag, "open"), context);
  return tag;
}

}  // namespace

OpenBoundary::OpenBoundary(const std::string& formula, int dimension, const NamedGrids& grids)
    : text_(formula),
      formula_(formula, dimension, "--open-boundary",
               dimension == 3 ? Expression::Names::shape_on_sphere : Expression::Names::shape_too,
               grids.fields_in(formula)) {}

std::int64_t OpenBoundary::tag(pnpbs_domain domain, pnpbs_context context) {
  formula_.set_shape_domain(domain, context);
  std::int64_t count = 0;
  check(pnpbs_domain_tag_outline(domain, call_negated, formula_.as_user(),
                                 tag_of_open(domain, context), &count),
        context);
  if (count == 0)
    throw BadInput("--open-boundary: '" + text_ +
                   "' is greater than 0 nowhere on the boundary around the domain");
  return count;
}

}  // namespace pnpbs::tool
