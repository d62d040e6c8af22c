// SPDX-License-Identifier: BSD-3-Clause
// Spacings from values at the nodes of a background mesh of which every rank has a copy, in the
// plane, in space and on a sphere.
#pragma once

#include <cstdint>
#include <optional>

#include "spacing/given_field.hpp"
#include "spacing/nodal_patch.hpp"
#include "spacing/sphere_patch.hpp"

namespace pnpbs {

// A spacing that is linear on each simplex of a background mesh. Outside the mesh d is the value at
// the nearest point of the mesh.
template <int Dim>
class MeshSpacing : public LocalSpacing<Dim> {
 public:
  // `field` must be checked and have elements.
  explicit MeshSpacing(const GivenField<Dim>& field);
  void evaluate(std::int64_t n, const Point<Dim>* x, double* d) const override;
  SpacingHints<Dim> spacing_hints() const override;
  std::optional<GivenExtent<Dim>> extent() const override;
  void distance_to_extent(std::int64_t n, const Point<Dim>* x, double* distance) const override;

 private:
  PatchAnswer<Dim> answer_at(const Point<Dim>& x) const;

  NodalPatch<Dim> mesh_;
  Box<Dim> box_;
};

extern template class MeshSpacing<2>;
extern template class MeshSpacing<3>;

// A spacing that is linear on each triangle of a background mesh on a sphere. Outside the mesh d is
// the value at the nearest point of the border.
class SphereMeshSpacing : public LocalSpacing<3> {
 public:
  // `field` must be checked and have triangles, with points on the sphere.
  SphereMeshSpacing(const SphereField& field, double radius);

  void evaluate(std::int64_t n, const Point<3>* x, double* d) const override;
  SpacingHints<3> spacing_hints() const override;
  std::optional<GivenExtent<3>> extent() const override;
  void distance_to_extent(std::int64_t n, const Point<3>* x, double* distances) const override;

 private:
  PatchAnswer<2> answer_at(const Point<3>& x) const;

  double radius_;
  SpherePatch mesh_;
};

}  // namespace pnpbs
