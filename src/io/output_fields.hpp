// SPDX-License-Identifier: BSD-3-Clause
// Output fields: values at nodes that the caller adds to files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "results/nodal_results.hpp"

namespace pnpbs::io {

// An output field.
struct OutputField {
  std::string name;
  std::int64_t components = 1;
  std::vector<double> values;    // [nodes][components]
  std::uint64_t nodes_hash = 0;  // hash of the nodes for which it was added
};

// Throws Error(ErrorKind::argument) unless the field can be added to the existing ones. `n` is the
// number of values per component, `owners` the number of owned nodes or particles, and `called`
// their name in messages.
void require_new_field(const std::vector<OutputField>& all, const std::string& name, std::int64_t n,
                       std::int64_t owners, const char* called, std::int64_t components,
                       const double* values);
// Throws Error(ErrorKind::argument) unless all ranks have added the same fields in the same order.
// Collective.
void require_same_fields(const Communicator& comm, const std::vector<OutputField>& all);

// The output fields of a placement.
class OutputFields {
 public:
  // Adds a field. `values` are [n][components] in the order of the results; those of ghosts are
  // ignored. Throws Error(ErrorKind::argument). Local.
  void add(NodalResults& results, const std::string& name, std::int64_t n, std::int64_t components,
           const double* values);
  void clear() { all_.clear(); }
  const std::vector<OutputField>& all() const { return all_; }
  // Throws unless the fields belong to the current nodes and are the same on all ranks. Collective.
  void require_current(NodalResults& results) const;
  // Returns the fields with values at ghosts. Collective.
  std::vector<OutputField> with_ghosts(NodalResults& results) const;

 private:
  std::vector<OutputField> all_;
};

}  // namespace pnpbs::io
