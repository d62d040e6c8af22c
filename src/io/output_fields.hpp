// SPDX-License-Identifier: BSD-3-Clause
// Fields of the caller's that files hold beside what is the library's: values at nodes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "results/nodal_results.hpp"

namespace pnpbs::io {

struct OutputField {
  std::string name;
  std::int64_t components = 1;
  std::vector<double> values;    // [places][components]
  std::uint64_t nodes_hash = 0;  // of the nodes that it belongs to
};

// Throws Error(ErrorKind::argument) unless such a field can be added to those there are, with n
// values for so many owners, as messages call them: nodes, particles.
void require_new_field(const std::vector<OutputField>& all, const std::string& name, std::int64_t n,
                       std::int64_t owners, const char* called, std::int64_t components,
                       const double* values);
// Throws it unless all ranks have added the same fields in the same order. Collective.
void require_same_fields(const Communicator& comm, const std::vector<OutputField>& all);

class OutputFields {
 public:
  // values: [n][components], in places; those of ghosts are left out. Throws
  // Error(ErrorKind::argument). Local.
  void add(NodalResults& results, const std::string& name, std::int64_t n, std::int64_t components,
           const double* values);
  void clear() { all_.clear(); }
  const std::vector<OutputField>& all() const { return all_; }
  // Throws unless they belong to the nodes there are, and are the same on all ranks. Collective.
  void require_current(NodalResults& results) const;
  // With values at ghosts, too. Collective.
  std::vector<OutputField> with_ghosts(NodalResults& results) const;

 private:
  std::vector<OutputField> all_;
};

}  // namespace pnpbs::io
