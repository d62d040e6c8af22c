// SPDX-License-Identifier: BSD-3-Clause
// The density of the matter that nodes represent, and the masses of nodes.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tool/expression.hpp"
#include "tool/library.hpp"
#include "tool/ranks.hpp"

namespace pnpbs::tool {

class Density {
 public:
  // Parses a formula in the coordinates. Throws BadInput.
  Density(const std::string& text, int dimension);

  // Returns the densities at the points x: [n][dimension]. Local. Throws BadInput with the location
  // if a value is not positive and finite.
  std::vector<double> at(std::span<const double> x) const;

  // Evaluates the density at the initial nodes, so that errors appear before the long run.
  // Collective. Throws BadInput.
  void check_at_nodes_of(pnpbs_placement placement, pnpbs_context context,
                         const Ranks& ranks) const;

  int dimension() const { return dimension_; }  // number of coordinates of a point

 private:
  int dimension_;
  Expression formula_;
};

// Returns the coordinates of the owned nodes: [n][dimension]. Local.
std::vector<double> coordinates_of(pnpbs_placement placement, int dimension, pnpbs_context context);

// Adds a field to the output files: a name and one value per owned node.
using AddField = std::function<void(const char* name, const std::vector<double>& values)>;

// Adds the fields "density" and "mass" (density times volume) of the owned nodes at x. Returns the
// total mass on the first rank, where it does not depend on the number of ranks, and 0 on the
// others. Collective. Throws Failure.
double add_masses(const Density& density, std::span<const double> x,
                  std::span<const double> volumes, const AddField& add, const Ranks& ranks);

}  // namespace pnpbs::tool
