// SPDX-License-Identifier: BSD-3-Clause
// The spacing from values at the nodes of a background mesh that every rank has whole: linear on
// each simplex, beyond the mesh what it is at its nearest point.
#pragma once

#include <cstdint>
#include <optional>

#include "spacing/given_field.hpp"
#include "spacing/nodal_patch.hpp"
#include "spacing/sphere_patch.hpp"

namespace pnpbs {

template <int Dim>
class MeshSpacing : public LocalSpacing<Dim> {
 public:
  // Of a checked field with elements.
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

// The spacing from values at the nodes of a background mesh on a sphere, which every rank has
// whole: linear on each triangle; beyond the mesh what it is at the nearest point of its border.
class SphereMeshSpacing : public LocalSpacing<3> {
 public:
  // Of a checked field with triangles, whose points lie on the sphere.
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
