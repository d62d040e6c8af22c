// SPDX-License-Identifier: BSD-3-Clause
// A spacing that the user writes as a formula in x and y.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace pnpbs::tool {

class Expression {
 public:
  // Throws BadInput with the text and a mark below the place of the error.
  explicit Expression(const std::string& text);
  ~Expression();

  bool is_constant() const;  // neither x nor y occurs in it
  double at(double x, double y) const;
  void at(std::int64_t n, const double* xy, double* values) const;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

// Functions and constants, in words, for the help text.
std::string expression_help();

}  // namespace pnpbs::tool
