// SPDX-License-Identifier: BSD-3-Clause
// The density of the matter that nodes stand for, and their masses.
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
  // A formula in the coordinates. Throws BadInput.
  Density(const std::string& text, int dimension);

  // x: [n][dimension]. Throws BadInput that names a place where it is no density. Local.
  std::vector<double> at(std::span<const double> x) const;

  // Before the long run: at the first nodes. Collective. Throws BadInput.
  void check_at_nodes_of(pnpbs_placement placement, pnpbs_context context,
                         const Ranks& ranks) const;

  int dimension() const { return dimension_; }  // of places

 private:
  int dimension_;
  Expression formula_;
};

// Of this rank's nodes: [n][dimension]. Local.
std::vector<double> coordinates_of(pnpbs_placement placement, int dimension, pnpbs_context context);

// A field for files: values at this rank's nodes.
using AddField = std::function<void(const char* name, const std::vector<double>& values)>;

// Adds the fields "density" and "mass", density times volume, of nodes at x. Returns the sum of all
// masses on the first rank, which is the same for any number of ranks; 0 on the others. Collective.
// Throws Failure.
double add_masses(const Density& density, std::span<const double> x,
                  std::span<const double> volumes, const AddField& add, const Ranks& ranks);

}  // namespace pnpbs::tool
