// SPDX-License-Identifier: BSD-3-Clause
#include "checkpoint/domain_fingerprint.hpp"

#include "base/error.hpp"
#include "base/mixed_hash.hpp"

namespace pnpbs {

namespace {

// A hash of numbers in the order of their addition.
class Fingerprint {
 public:
  void add(double value) { value_ = mixed_with(value_, value); }
  template <std::size_t Dim>
  void add(const std::array<double, Dim>& x) {
    for (double coordinate : x) add(coordinate);
  }
  template <int Dim>
  void add(const PeriodicCell<Dim>& cell) {
    if (!cell.any()) return;
    add(cell.box().low);
    add(cell.box().high);
    for (int k = 0; k < Dim; ++k) add(cell.period(k));
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0;
};

}  // namespace

std::uint64_t fingerprint_of(const PlaneDomain& domain) {
  Fingerprint print;
  if (const Embedding<2>& in = domain.embedding(); in.is_sphere())
    print.add(in.chart().projection_centre());
  print.add(domain.cell());
  // The patch that closes a whole sphere depends on the spacing and is no part of the user's
  // domain.
  const bool whole = domain.is_whole_sphere();
  for (const BoundaryCurve& curve : domain.curves()) {
    if (whole && curve.bounds()) continue;
    print.add(curve.tag);
    print.add(curve.left_inside);  // depend on the role and on holes
    print.add(curve.right_inside);
    for (const Point<2>& x : curve.points) print.add(x);
  }
  for (const Corner& corner : domain.corners())
    if (!whole) print.add(corner.tag);
  for (const FixedNode<2>& node : domain.fixed_nodes()) {
    if (domain.is_in_patch(node.position)) continue;
    print.add(node.tag);
    print.add(node.position);
  }
  return print.value();
}

std::uint64_t fingerprint_of(const VolumeDomain& domain) {
  Fingerprint print;
  print.add(domain.cell());
  for (const BoundaryNode<3>& node : domain.mesh().nodes) print.add(node.position);
  for (const BoundaryTriangle& facet : domain.mesh().facets) {
    for (const std::int32_t node : facet.nodes) print.add(node);
    print.add(facet.tag);
    print.add(facet.front_inside);
    print.add(facet.back_inside);
  }
  for (const FeatureCurve& curve : domain.features().curves)
    for (const std::int32_t node : curve.nodes) print.add(node);
  return print.value();
}

namespace {

void require_same(const Communicator& comm, std::uint64_t fingerprint) {
  if (!comm.same_on_all(fingerprint))
    throw Error(ErrorKind::domain,
                "the domains differ between ranks: every rank describes the whole domain");
}

}  // namespace

void require_same_domain(const Communicator& comm, const PlaneDomain& domain) {
  require_same(comm, fingerprint_of(domain));
}
void require_same_domain(const Communicator& comm, const VolumeDomain& domain) {
  require_same(comm, fingerprint_of(domain));
}

}  // namespace pnpbs
