// SPDX-License-Identifier: BSD-3-Clause
// The check of the results on surfaces alone.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/space_vectors.hpp"
#include "comm/records.hpp"
#include "placement/element_measure.hpp"
#include "placement/result_check.hpp"
#include "placement/volume_node_check.hpp"

namespace pnpbs {

namespace {

struct SentTriangle {
  std::int64_t of, next, last;  // ids: the star of `of` must have the other two, in this order
  std::int64_t owner;           // of `of`
};

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
  using Others = std::array<std::int32_t, 2>;

  bool star_has(std::int64_t i, std::int64_t next, std::int64_t last) const;
  void check_stars() const;
  void check_corner(std::int64_t corner, std::int64_t next, std::int64_t last,
                    std::vector<SentTriangle>& elsewhere) const;
  [[noreturn]] void fail_of_star(const std::string& of, std::int64_t next, std::int64_t last) const;

  void check_area() const;
};

// ------------------------------------------------------------------ stars ----------------------

bool SurfaceResultCheck::star_has(std::int64_t i, std::int64_t next, std::int64_t last) const {
  bool found = false;
  level_.stars.for_triangles(i, [&](const Others& others) {
    found = found || (nodes_.id(others[0]) == next && nodes_.id(others[1]) == last);
  });
  return found;
}

void SurfaceResultCheck::fail_of_star(const std::string& of, std::int64_t next,
                                      std::int64_t last) const {
  fail_check("the star of node " + of + " lacks the triangle with nodes " + std::to_string(next) +
             " and " + std::to_string(last));
}

void SurfaceResultCheck::check_corner(std::int64_t corner, std::int64_t next, std::int64_t last,
                                      std::vector<SentTriangle>& elsewhere) const {
  if (!nodes_.owned(corner))
    elsewhere.push_back({nodes_.id(corner), nodes_.id(next), nodes_.id(last), owner_of(corner)});
  else if (!star_has(corner, nodes_.id(next), nodes_.id(last)))
    fail_of_star(name(corner), nodes_.id(next), nodes_.id(last));
}

void SurfaceResultCheck::check_stars() const {
  std::vector<SentTriangle> elsewhere;
  for_owned([&](std::int64_t i) {
    level_.stars.for_triangles(i, [&](const Others& others) {
      check_corner(others[0], others[1], i, elsewhere);
      check_corner(others[1], i, others[0], elsewhere);
    });
  });
  if (comm_.size() == 1) return;
  for (const SentTriangle& t : redistribute(comm_, elsewhere, [](const SentTriangle& sent) {
         return static_cast<int>(sent.owner);
       })) {
    const std::int64_t i = owned_node(t.of);
    if (i < 0 || !star_has(i, t.next, t.last))
      fail_of_star(i < 0 ? std::to_string(t.of) : name(i), t.next, t.last);
  }
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
