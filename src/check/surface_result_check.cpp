// SPDX-License-Identifier: BSD-3-Clause
// The check of the results on surfaces alone.
#include <array>
#include <cstdint>

#include "check/corner_check.hpp"
#include "check/element_measure.hpp"
#include "check/result_check.hpp"
#include "check/volume_node_check.hpp"

namespace pnpbs {

namespace {

// The check of surfaces alone. Triangles are checked only if `fills` is true.
class SurfaceResultCheck : public VolumeNodeCheck {
 public:
  explicit SurfaceResultCheck(const Results<3>& results) : VolumeNodeCheck(results) {}

  void check(bool fills) const {
    check_nodes_and_lists();
    if (!fills) return;
    check_stars();
    check_area();
  }

 private:
  void check_stars() const;
  void check_area() const;
};

// ------------------------------------------------------------------ stars ----------------------

void SurfaceResultCheck::check_stars() const {
  CornerCheck<3, 2> corners(*this);
  for_owned([&](std::int64_t i) {
    level_.stars.for_triangles(i, [&](const std::array<std::int32_t, 2>& others) {
      const auto [next, last] = others;
      corners.look_at(next, {last, i});
      corners.look_at(last, {i, next});
    });
  });
  corners.check_on_other_ranks();
}

// ------------------------------------------------------------------ area -----------------------

void SurfaceResultCheck::check_area() const {
  const ElementMeasure measure = measure_of_elements(p_);
  if (!measure.agrees())
    fail_check("the triangles have the area " + number_text(measure.elements) + ", the surfaces " +
               number_text(measure.domain) + ", and no more than " + rounded_text(measure.between) +
               " lies between them");
}

}  // namespace

void check_surfaces(const Results<3>& results, bool fills) {
  SurfaceResultCheck(results).check(fills);
}

}  // namespace pnpbs
