// SPDX-License-Identifier: BSD-3-Clause
#include "tool/primitive.hpp"

#include <array>
#include <filesystem>

#include "tool/exit.hpp"
#include "tool/names.hpp"
#include "tool/numbers.hpp"

namespace pnpbs::tool {
namespace {

struct Shape {
  const char* name;
  std::size_t numbers;
  const char* usage;
};

constexpr std::array shapes{
    Shape{"box", 6, "box(x0,y0,z0, x1,y1,z1), two opposite corners"},
    Shape{"ball", 4, "ball(x,y,z, r), centre and radius"},
    Shape{"cylinder", 7, "cylinder(x0,y0,z0, x1,y1,z1, r), the ends of its axis and the radius"}};

const Shape& shape_called(const std::string& name) {
  std::vector<std::string> names{"levelset"};
  for (const Shape& shape : shapes) {
    if (shape.name == name) return shape;
    names.emplace_back(shape.name);
  }
  throw BadInput("--domain: there is no file and no body '" + name + "'" +
                 did_you_mean(name, names) + " (known: box, ball, cylinder, levelset)");
}

}  // namespace

std::optional<Primitive> primitive_in(const std::string& text) {
  const std::size_t open = text.find('(');
  if (open == 0 || open == std::string::npos || !text.ends_with(')')) return std::nullopt;
  if (text.find('/') != std::string::npos) return std::nullopt;
  std::error_code error;
  if (std::filesystem::exists(text, error)) return std::nullopt;
  Primitive primitive{text.substr(0, open), {}};
  const Shape& shape = shape_called(primitive.shape);
  const auto numbers = numbers_between_commas(text.substr(open + 1, text.size() - open - 2));
  if (!numbers || numbers->size() != shape.numbers)
    throw BadInput("--domain: '" + text + "' is not " + shape.usage);
  primitive.numbers = *numbers;
  return primitive;
}

void add(const Primitive& primitive, pnpbs_domain domain, pnpbs_context context) {
  constexpr std::int32_t tag = 1;
  const double* x = primitive.numbers.data();
  if (primitive.shape == "box") check(pnpbs_domain_add_box(domain, x, x + 3, tag), context);
  if (primitive.shape == "ball") check(pnpbs_domain_add_ball(domain, x, x[3], tag), context);
  if (primitive.shape == "cylinder")
    check(pnpbs_domain_add_cylinder(domain, x, x + 3, x[6], tag), context);
}

}  // namespace pnpbs::tool
