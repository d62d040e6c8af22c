// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/sphere_spacing.hpp"

#include <cmath>

#include "base/error.hpp"
#include "base/point_text.hpp"

namespace pnpbs {

void SphereSpacing::evaluate(std::int64_t n, const Point<2>* u, double* d) const {
  for_points_on_sphere(
      chart_, n, u, [&](std::int64_t begin, std::int64_t count, const Point<3>* x) {
        along_->evaluate(count, x, d + begin);
        for (std::int64_t i = 0; i < count; ++i) {
          double& value = d[begin + i];
          if (!std::isfinite(value) || value <= 0)
            throw Error(ErrorKind::spacing, "the spacing at " + point_text(x[i]) + " is " +
                                                number_text(value) +
                                                "; it must be finite and greater than 0");
          value *= chart_.stretch(u[begin + i]);
        }
      });
}

}  // namespace pnpbs
