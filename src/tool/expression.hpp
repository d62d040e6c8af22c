// SPDX-License-Identifier: BSD-3-Clause
// A spacing that the user writes as a formula in x and y, and z for bodies.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace pnpbs::tool {

class Expression {
 public:
  // Throws BadInput with the text and a mark below the place of the error.
  Expression(const std::string& text, int dimension);
  ~Expression();

  bool is_constant() const;  // no coordinate occurs in it
  double at(const double* place) const;
  // coordinates: [n][dimension]
  void at(std::int64_t n, const double* coordinates, double* values) const;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

// Functions and constants, in words, for the help text.
std::string expression_help();

}  // namespace pnpbs::tool
