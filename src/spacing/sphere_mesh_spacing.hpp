// SPDX-License-Identifier: BSD-3-Clause
// The spacing from values at the nodes of a background mesh on a sphere, which every rank has
// whole: linear on each triangle, at the point of it on the ray from the centre of the sphere;
// beyond the mesh what it is at the nearest point of its border. In space, so that no triangle is
// different from others: in a chart those about the point that it is projected from are unbounded.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "spacing/given_field.hpp"
#include "spacing/nodal_patch.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

class SphereMeshSpacing : public LocalSpacing<3> {
 public:
  // Of a checked field with triangles, whose points lie on the sphere.
  SphereMeshSpacing(const SphereField& field, double radius);

  void evaluate(std::int64_t n, const Point<3>* x, double* d) const override;
  KnownValues<3> known_values() const override;
  std::optional<GivenExtent<3>> extent() const override;
  void distance_to_extent(std::int64_t n, const Point<3>* x, double* distances) const override;

 private:
  using Answer = PatchAnswer<2>;

  Answer answer_at(const Point<3>& x) const;
  void interpolate(const Point<3>& x, Answer& best) const;
  void extend(const Point<3>& x, Answer& best) const;

  double radius_;
  Patch<3> nodes_;  // without simplices
  std::vector<std::array<std::int32_t, 3>> triangles_;
  std::vector<std::array<std::int32_t, 2>> border_;  // sides of one triangle alone
  BoxTree<3> by_triangle_, by_side_;
};

}  // namespace pnpbs
