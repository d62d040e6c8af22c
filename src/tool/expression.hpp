// SPDX-License-Identifier: BSD-3-Clause
// What the user writes as a formula in x and y, and z for bodies: a spacing, a level set. A spacing
// may ask for the shape of the domain, too.
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
  enum class Names { coordinates, shape_too, shape_on_sphere };  // the last: lon and lat, too
  // What a name in it stands for: values at n places.
  struct Field {
    std::string name;
    std::function<void(std::int64_t n, const double* coordinates, double* values)> values;
    std::string option = "--spacing-grid";  // that gives it
  };

  // `option` is the one that it was given by. Throws BadInput with the text and a mark below the
  // place of the error.
  Expression(const std::string& text, int dimension, const std::string& option,
             Names names = Names::coordinates, std::vector<Field> fields = {});
  ~Expression();

  // The domain whose shape it asks for, if it does; it must outlive its use. Finds the groups that
  // it names, and asks for all of that at one place. Local. Throws Failure if the domain does not
  // have it.
  void ask_shape_of(pnpbs_domain domain, pnpbs_context context);

  bool is_constant() const;  // neither a coordinate nor the shape occurs in it
  double at(const double* place) const;
  // coordinates: [n][dimension]
  void at(std::int64_t n, const double* coordinates, double* values) const;

  void* as_user() const { return const_cast<Expression*>(this); }

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

// A callback of the library's, with an expression's as_user(). It fails when a signal has come.
std::int32_t call_expression(std::int64_t n, std::int32_t dim, const double* coordinates,
                             double* values, void* user);

// Functions and constants, in words, for the help text.
std::string expression_help();

}  // namespace pnpbs::tool
