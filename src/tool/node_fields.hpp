// SPDX-License-Identifier: BSD-3-Clause
// Fields that --field NAME=FORMULA adds to the files: values of the formula at the nodes.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tool/arguments.hpp"
#include "tool/density.hpp"
#include "tool/expression.hpp"
#include "tool/library.hpp"
#include "tool/named_grids.hpp"
#include "tool/ranks.hpp"

namespace pnpbs::tool {

class NodeFields {
 public:
  // Parses the formulas. The grids must outlive this object. dimension: number of coordinates of a
  // point. Throws BadInput.
  NodeFields(const Arguments& arguments, int dimension, const NamedGrids& grids);

  std::vector<std::string> formulas() const;

  // Adds the fields to the initial nodes and removes them again, so that errors appear before the
  // long run. The domain, whose shape a formula may use, must outlive the use of this object.
  // Collective. Throws Failure, also if a value is not finite.
  void check_at_nodes_of(pnpbs_placement placement, pnpbs_domain domain, pnpbs_context context,
                         const Ranks& ranks);
  // Adds the fields to the nodes, or to the particles if `particles` is not null. Collective.
  // Throws Failure.
  void add_to(pnpbs_placement placement, pnpbs_particles particles, pnpbs_domain domain,
              pnpbs_context context, const Ranks& ranks);

 private:
  struct Field {
    std::string name, formula;
    std::unique_ptr<Expression> values;
  };
  // Returns the values at the points x: [n][dimension]. Local. Throws BadInput with the location if
  // a value is not finite.
  std::vector<double> values_at(const Field& field, std::span<const double> x) const;
  void add(std::span<const double> x, pnpbs_domain domain, pnpbs_context context,
           const AddField& add) const;

  int dimension_;
  bool sphere_;
  std::vector<Field> fields_;
};

}  // namespace pnpbs::tool
