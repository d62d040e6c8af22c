// SPDX-License-Identifier: BSD-3-Clause
// All particles in the order of their ids, with fields: the same whole for any number of ranks.
#pragma once

#include "comm/id_blocks.hpp"
#include "io/node_source.hpp"
#include "particles/particles.hpp"

namespace pnpbs::io {

class ParticlesById : public NodeSource {
 public:
  // All of it must outlive this. Collective.
  ParticlesById(const Communicator& comm, const Particles& particles, const GroupNames& names,
                const std::vector<OutputField>& fields);

  void for_nodes(const std::function<void(const NodeRows&)>& visit) const override;
  void for_field(std::size_t field,
                 const std::function<void(const FieldRows&)>& visit) const override;
  void for_elements(const std::function<void(const ElementRows&)>&) const override {}
  void for_facets(const std::function<void(const FacetRows&)>&) const override {}
  std::vector<TagGroup> node_groups() const override;

 private:
  template <class Row>
  std::vector<Row> brought(const std::vector<Row>& rows) const;

  const Communicator& comm_;
  const Particles& particles_;
  IdBlocks blocks_;
};

}  // namespace pnpbs::io
