// SPDX-License-Identifier: BSD-3-Clause
// The spacing of a placement, set through the C interface.
#include <cmath>

#include "api/placement_calls.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

namespace {

// Collective: make(p) is the spacing, which is replaced only if all ranks could make theirs.
template <class Make>
pnpbs_status replace_spacing(pnpbs_placement placement, const Make& make) {
  return local_change(placement, [&](Placement& p) {
    std::shared_ptr<const Spacing<2>> spacing;
    agreed(p.communicator(), [&] { spacing = make(p); });
    p.set_spacing(std::move(spacing));
    return PNPBS_OK;
  });
}

}  // namespace

pnpbs_status pnpbs_placement_set_spacing_constant(pnpbs_placement placement, double d) {
  return replace_spacing(placement, [&](Placement&) {
    if (!std::isfinite(d) || d <= 0)
      throw Error(ErrorKind::spacing, "argument d = " + number_text(d) +
                                          ": the spacing must be finite and greater than 0");
    return std::make_shared<ConstantSpacing<2>>(d);
  });
}

pnpbs_status pnpbs_placement_set_spacing_callback(pnpbs_placement placement,
                                                  pnpbs_spacing_fn spacing, void* user) {
  return replace_spacing(placement, [&](Placement&) {
    if (!spacing) throw Error(ErrorKind::argument, "argument spacing is NULL");
    return std::make_shared<CallbackSpacing<2>>(
        [spacing, user](std::int64_t n, const double* x, double* d) {
          const HostArithmetic arithmetic;
          return spacing(n, 2, x, d, user);
        });
  });
}

pnpbs_status pnpbs_placement_set_spacing_grid(pnpbs_placement placement, const int64_t* size,
                                              const double* origin, const double* step,
                                              const double* values) {
  return replace_spacing(placement, [&](Placement&) {
    require_pointer(size, "size");
    require_pointer(origin, "origin");
    require_pointer(step, "step");
    require_pointer(values, "values");
    constexpr std::int64_t kMax = std::int64_t{1} << 31;
    for (int k = 0; k < 2; ++k) {
      const std::string at = "[" + std::to_string(k) + "] = ";
      if (size[k] < 1 || size[k] > kMax)
        throw Error(ErrorKind::argument,
                    "argument size" + at + std::to_string(size[k]) + " must be in 1 .. 2^31");
      if (!std::isfinite(origin[k]))
        throw Error(ErrorKind::argument,
                    "argument origin" + at + number_text(origin[k]) + " must be finite");
      if (!std::isfinite(step[k]) || step[k] <= 0)
        throw Error(ErrorKind::argument,
                    "argument step" + at + number_text(step[k]) + " must be greater than 0");
    }
    const std::int64_t n = size[0] * size[1];
    for (std::int64_t i = 0; i < n; ++i)
      if (!std::isfinite(values[i]) || values[i] <= 0)
        throw Error(ErrorKind::spacing, "argument values[" + std::to_string(i / size[0]) + "][" +
                                            std::to_string(i % size[0]) +
                                            "] = " + number_text(values[i]) +
                                            ": the spacing must be finite and greater than 0");
    return std::make_shared<GridSpacing<2>>(
        std::array<std::int64_t, 2>{size[0], size[1]}, Point<2>{origin[0], origin[1]},
        Point<2>{step[0], step[1]}, std::vector<double>(values, values + n));
  });
}

pnpbs_status pnpbs_placement_set_spacing_at_nodes(pnpbs_placement placement, int64_t n,
                                                  const double* d) {
  return replace_spacing(placement, [&](Placement& p) {
    p.prepare_order();
    if (n != p.count())
      throw Error(ErrorKind::argument, "argument n = " + std::to_string(n) + "; this rank has " +
                                           std::to_string(p.count()) +
                                           " nodes, and every one has its value");
    if (n > 0) require_pointer(d, "d");
    for (std::int64_t i = 0; i < n; ++i)
      if (!std::isfinite(d[i]) || d[i] <= 0)
        throw Error(ErrorKind::spacing, "argument d[" + std::to_string(i) +
                                            "] = " + number_text(d[i]) + " at node " +
                                            std::to_string(p.level().nodes.id(p.node_at(i))) +
                                            ": the spacing must be finite and greater than 0");
    return p.spacing_from(std::vector<double>(d, d + n));
  });
}
