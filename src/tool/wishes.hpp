// SPDX-License-Identifier: BSD-3-Clause
// What the user asks for, before there is a domain.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tool/argument_rules.hpp"
#include "tool/arguments.hpp"
#include "tool/density.hpp"
#include "tool/domain.hpp"
#include "tool/named_grids.hpp"
#include "tool/node_fields.hpp"
#include "tool/outputs.hpp"
#include "tool/ranks.hpp"
#include "tool/spacing.hpp"

namespace pnpbs::tool {

// Made before anything is done, so that mistakes of the user are told first.
struct Wishes {
  std::optional<Outputs> outputs;
  std::optional<DomainSource> source;
  std::optional<NamedGrids> grids;
  std::optional<Spacing> spacing;
  std::optional<Density> density;
  std::optional<NodeFields> fields;
  Wishes(const Arguments& arguments, const Ranks& ranks) {
    ranks.agreed([&] {
      if (!arguments.dry_run) outputs.emplace(arguments, ranks);
      source.emplace(arguments);
      refuse_other_dimension(arguments, source->dimension());
      grids.emplace(arguments, source->dimension());
      spacing.emplace(arguments, source->dimension(), *grids);
      if (arguments.density) density.emplace(*arguments.density, source->dimension());
      fields.emplace(arguments, source->dimension(), *grids);
      require_use_of_grids();
    });
  }

  Wishes(const Wishes&) = delete;  // formulas refer to the grids
  Wishes& operator=(const Wishes&) = delete;

 private:
  void require_use_of_grids() const {
    std::vector<std::string> formulas = fields->formulas();
    formulas.insert(formulas.begin(), spacing->formula());
    grids->require_use_in(formulas);
  }
};

}  // namespace pnpbs::tool
