// SPDX-License-Identifier: BSD-3-Clause
// The spacing from values at the nodes of a background mesh that every rank has whole: linear on
// each simplex, beyond the mesh what it is at its nearest point.
#pragma once

#include "spacing/given_field.hpp"
#include "spacing/nodal_patch.hpp"

namespace pnpbs {

template <int Dim>
class MeshSpacing : public LocalSpacing<Dim> {
 public:
  // Of a checked field with elements.
  explicit MeshSpacing(const GivenField<Dim>& field);
  void evaluate(std::int64_t n, const Point<Dim>* x, double* d) const override;
  KnownValues<Dim> known_values() const override;
  std::optional<GivenExtent<Dim>> extent() const override;
  void distance_to_extent(std::int64_t n, const Point<Dim>* x, double* distance) const override;

 private:
  PatchAnswer<Dim> answer_at(const Point<Dim>& x) const;

  NodalPatch<Dim> mesh_;
  Box<Dim> box_;
};

extern template class MeshSpacing<2>;
extern template class MeshSpacing<3>;

}  // namespace pnpbs
