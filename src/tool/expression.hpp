// SPDX-License-Identifier: BSD-3-Clause
// A formula of the command line in x, y and, for bodies, z: a spacing, a level set, a density or a
// field. A spacing may also use the shape of the domain.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tool/library.hpp"

namespace pnpbs::tool {

class Expression {
 public:
  // the last one includes lon and lat
  enum class Names { coordinates, shape_too, shape_on_sphere };
  // A name in the formula that stands for values at n points.
  struct Field {
    std::string name;
    std::function<void(std::int64_t n, const double* coordinates, double* values)> values;
    std::string option = "--spacing-grid";  // that defines it
  };

  // Parses a formula. `option` is the command-line option that it was given by. Throws BadInput
  // with the text and a mark below the position of the error.
  Expression(const std::string& text, int dimension, const std::string& option,
             Names names = Names::coordinates, std::vector<Field> fields = {});
  ~Expression();

  // Sets the domain whose shape the formula uses. Finds the groups that the formula names, and
  // evaluates all shape functions at one point. The domain must outlive the use of this object.
  // Local. Throws Failure if the domain does not provide a property.
  void set_shape_domain(pnpbs_domain domain, pnpbs_context context);

  bool is_constant() const;  // neither a coordinate nor the shape occurs in the formula
  double at(const double* place) const;
  // Evaluates batches on the threads of the library from now on. A placement must exist, because it
  // is what starts them.
  void use_threads() { uses_threads_ = true; }
  // Evaluates the formula at n points, on one thread if it uses the shape. coordinates:
  // [n][dimension].
  void at(std::int64_t n, const double* coordinates, double* values) const;

  void* as_user() const { return const_cast<Expression*>(this); }

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
  bool uses_threads_ = false;
  mutable std::vector<std::unique_ptr<Parser>> of_other_threads_;  // copies of it
};

// A callback for the library; `user` is as_user() of an expression. It fails after a signal.
std::int32_t call_expression(std::int64_t n, std::int32_t dim, const double* coordinates,
                             double* values, void* user);

// Returns the functions and constants as text for the help.
std::string expression_help();

}  // namespace pnpbs::tool
