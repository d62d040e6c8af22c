// SPDX-License-Identifier: BSD-3-Clause
// Fields that the user asks for in files, --field NAME=FORMULA: values of the formula at the nodes.
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
  // Of formulas in these grids, which must outlive this object. dimension: of places. Throws
  // BadInput.
  NodeFields(const Arguments& arguments, int dimension, const NamedGrids& grids);

  std::vector<std::string> formulas() const;

  // Before the long run: adds them to the first nodes, to see if that works, and takes them away.
  // The domain, whose shape a formula may ask for, must outlive this object's use. Collective.
  // Throws Failure, also where a value is not finite.
  void check_at_nodes_of(pnpbs_placement placement, pnpbs_domain domain, pnpbs_context context,
                         const Ranks& ranks);
  // The same to files of nodes, or of particles if there are any. Collective. Throws Failure.
  void add_to(pnpbs_placement placement, pnpbs_particles particles, pnpbs_domain domain,
              pnpbs_context context, const Ranks& ranks);

 private:
  struct Field {
    std::string name, formula;
    std::unique_ptr<Expression> values;
  };
  // x: [n][dimension]. Local. Throws BadInput that names a place where a value is not finite.
  std::vector<double> values_at(const Field& field, std::span<const double> x) const;
  void add(std::span<const double> x, pnpbs_domain domain, pnpbs_context context,
           const AddField& add) const;

  int dimension_;
  bool sphere_;
  std::vector<Field> fields_;
};

}  // namespace pnpbs::tool
