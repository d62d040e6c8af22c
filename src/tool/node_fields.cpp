// SPDX-License-Identifier: BSD-3-Clause
#include "tool/node_fields.hpp"

#include <cmath>

#include "tool/numbers.hpp"

namespace pnpbs::tool {
namespace {

constexpr const char* option = "--field";

// Removes spaces at both ends.
std::string without_spaces(const std::string& name) {
  const std::size_t first = name.find_first_not_of(' '), last = name.find_last_not_of(' ');
  return first == std::string::npos ? "" : name.substr(first, last + 1 - first);
}

// Rejects names of columns in files, and of fields that other options add after the run.
void refuse_taken(const std::string& name, const Arguments& arguments) {
  const bool masses = arguments.density.has_value();
  const bool volumes = arguments.volumes || masses || arguments.at_centres;
  const bool is_taken = name == "x" || name == "y" || name == "z" || name == "region" ||
                        name == "boundary_tag" || name == "mesh" || name.starts_with("mesh_") ||
                        (volumes && name == "volume") ||
                        (masses && (name == "density" || name == "mass"));
  if (is_taken)
    throw BadInput(std::string(option) + ": files have '" + name +
                   "' already; choose another name");
}

// Returns the coordinates of this rank's particles.
std::vector<double> coordinates_of(pnpbs_particles particles, pnpbs_context context) {
  std::int32_t dimension = 0;
  std::int64_t count = 0;
  check(pnpbs_particles_sizes(particles, &dimension, &count, nullptr), context);
  std::vector<double> x(static_cast<std::size_t>(dimension * count));
  check(pnpbs_particles_get(particles, count, x.data(), nullptr, nullptr, nullptr, nullptr),
        context);
  return x;
}

}  // namespace

NodeFields::NodeFields(const Arguments& arguments, int dimension, const NamedGrids& grids)
    : dimension_(dimension), sphere_(arguments.sphere.has_value()) {
  for (const std::string& text : arguments.fields) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
      throw BadInput(std::string(option) + ": expected NAME=FORMULA, found '" + text + "'");
    Field field{without_spaces(text.substr(0, equals)), text.substr(equals + 1), nullptr};
    if (field.name.starts_with('-'))
      throw BadInput(std::string(option) + ": '" + field.name + "' begins with no letter");
    refuse_taken(field.name, arguments);
    for (const Field& other : fields_)
      if (other.name == field.name)
        throw BadInput(std::string(option) + ": '" + field.name + "' is given twice");
    field.values = std::make_unique<Expression>(
        field.formula, dimension, option + (" " + field.name),
        sphere_ ? Expression::Names::shape_on_sphere : Expression::Names::shape_too,
        grids.fields_in(field.formula));
    fields_.push_back(std::move(field));
  }
}

std::vector<std::string> NodeFields::formulas() const {
  std::vector<std::string> formulas;
  for (const Field& field : fields_) formulas.push_back(field.formula);
  return formulas;
}

std::vector<double> NodeFields::values_at(const Field& field, std::span<const double> x) const {
  const auto dimension = static_cast<std::size_t>(dimension_);
  std::vector<double> values(x.size() / dimension);
  field.values->at(std::ssize(values), x.data(), values.data());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      throw BadInput(std::string(option) + " " + field.name + ": expected finite values, found " +
                     short_number(values[i], 6) + " at " +
                     place_text(&x[dimension * i], dimension_, sphere_));
  return values;
}

void NodeFields::add(std::span<const double> x, pnpbs_domain domain, pnpbs_context context,
                     const AddField& add) const {
  for (const Field& field : fields_) {
    field.values->set_shape_domain(domain, context);
    add(field.name.c_str(), values_at(field, x));
  }
}

void NodeFields::check_at_nodes_of(pnpbs_placement placement, pnpbs_domain domain,
                                   pnpbs_context context, const Ranks& ranks) {
  if (fields_.empty()) return;
  add_to(placement, nullptr, domain, context, ranks);
  check(pnpbs_placement_clear_output_fields(placement), context);
}

void NodeFields::add_to(pnpbs_placement placement, pnpbs_particles particles, pnpbs_domain domain,
                        pnpbs_context context, const Ranks& ranks) {
  if (fields_.empty()) return;
  ranks.collective_try([&] {
    const std::vector<double> x = particles ? coordinates_of(particles, context)
                                            : coordinates_of(placement, dimension_, context);
    add(x, domain, context, [&](const char* name, const std::vector<double>& values) {
      const std::int64_t n = std::ssize(values);
      const pnpbs_status status =
          particles ? pnpbs_particles_add_output_field(particles, name, n, 1, values.data())
                    : pnpbs_placement_add_output_field(placement, name, n, 1, values.data());
      if (status < 0)
        throw BadInput(std::string(option) + " " + name + ": " + pnpbs_last_error(context));
    });
  });
}

}  // namespace pnpbs::tool
