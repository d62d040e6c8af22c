// SPDX-License-Identifier: BSD-3-Clause
#include "io/write_particles.hpp"

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "comm/id_blocks.hpp"
#include "comm/records.hpp"
#include "io/node_source.hpp"
#include "io/tag_groups.hpp"
#include "particles/particles.hpp"

namespace pnpbs::io {
namespace {

// A source with all particles in the order of their ids, with fields. The result does not depend on
// the number of ranks.
class ParticlesById : public NodeSource {
 public:
  // All arguments must outlive this object. Collective.
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

struct ParticleRow {
  std::int64_t id;
  std::array<double, 3> x;
  double d;
  std::int32_t tag;
};

struct ParticleValue {
  std::int64_t id, component;
  double value;
};

void add_to_groups(const Particles& particles, TagGroups& groups) {
  const auto dimension = static_cast<std::size_t>(particles.dimension);
  for (std::size_t i = 0; i < particles.ids.size(); ++i) {
    Point<3> x{};
    std::copy_n(&particles.x[dimension * i], dimension, x.begin());
    groups.add(particles.tags[i], {&x, 1});
  }
}

ParticlesById::ParticlesById(const Communicator& comm, const Particles& particles,
                             const GroupNames& names, const std::vector<OutputField>& fields)
    : comm_(comm),
      particles_(particles),
      blocks_(comm, static_cast<std::int64_t>(particles.ids.size()),
              [&](std::int64_t i) { return particles.ids[static_cast<std::size_t>(i)]; }) {
  contents_.dimension = contents_.coordinates = particles.dimension;
  contents_.nodes = particles.all;
  contents_.names = &names;
  contents_.fields = &fields;
}

// Sends each row to the rank whose block of ids contains it. Collective.
template <class Row>
std::vector<Row> ParticlesById::brought(const std::vector<Row>& rows) const {
  return redistribute<Row>(comm_, rows, [&](const Row& row) { return blocks_.rank_of(row.id); });
}

void ParticlesById::for_nodes(const std::function<void(const NodeRows&)>& visit) const {
  const auto dimension = static_cast<std::size_t>(particles_.dimension);
  std::vector<ParticleRow> own;
  for (std::size_t i = 0; i < particles_.ids.size(); ++i) {
    ParticleRow row{particles_.ids[i], {}, particles_.spacing[i], particles_.tags[i]};
    std::copy_n(&particles_.x[dimension * i], dimension, row.x.begin());
    own.push_back(row);
  }
  own = brought(own);
  std::ranges::sort(own, {}, &ParticleRow::id);
  NodeRows rows;
  rows.first = blocks_.numbers().first;
  for (const ParticleRow& row : own) {
    rows.ids.push_back(row.id);
    rows.x.insert(rows.x.end(), row.x.begin(),
                  row.x.begin() + static_cast<std::ptrdiff_t>(dimension));
    rows.spacing.push_back(row.d);
    rows.tags.push_back(row.tag);
  }
  visit(rows);
}

void ParticlesById::for_field(std::size_t field,
                              const std::function<void(const FieldRows&)>& visit) const {
  const OutputField& of = (*contents_.fields)[field];
  std::vector<ParticleValue> values;
  for (std::size_t k = 0; k < of.values.size(); ++k) {
    const auto components = static_cast<std::size_t>(of.components);
    values.push_back(
        {particles_.ids[k / components], static_cast<std::int64_t>(k % components), of.values[k]});
  }
  values = brought(values);
  std::ranges::sort(values, {},
                    [](const ParticleValue& v) { return std::pair(v.id, v.component); });
  FieldRows rows;
  rows.first = blocks_.numbers().first;
  for (const ParticleValue& value : values) rows.values.push_back(value.value);
  visit(rows);
}

std::vector<TagGroup> ParticlesById::node_groups() const {
  TagGroups groups;
  add_to_groups(particles_, groups);
  return groups.of_all(comm_);
}

// Throws for formats that need a placement (pieces) or elements.
void require_formats_of_points(const std::vector<FileRequest>& requests) {
  for (const FileRequest& request : requests)
    if (!request.format->write || request.format->elements == Elements::always)
      throw Error(ErrorKind::argument, std::string("a .") + request.format->name +
                                           " file cannot contain particles: '" + request.path +
                                           "'");
}

}  // namespace

void write_particles(const std::shared_ptr<const Communicator>& comm, const Particles& particles,
                     const GroupNames& names, const std::vector<OutputField>& fields,
                     const std::vector<FileRequest>& requests, const AsksToStop& requests_stop) {
  std::size_t done = 0;
  const auto give_up = [&] { give_up_if_asked(requests_stop, done, requests.size()); };
  collective_try(*comm, [&] {
    require_formats_of_points(requests);
    require_hdf5_for(requests, *comm);
    require_same_fields(*comm, fields);
    require_fields_for(requests, fields);
    const ParticlesById nodes(*comm, particles, names, fields);
    std::vector<std::unique_ptr<SharedFile>> files;
    for (const FileRequest& request : requests) {
      SharedFile& file =
          *files.emplace_back(std::make_unique<SharedFile>(comm, request.path, give_up));
      request.format->write(nodes, file);
      file.close();
      ++done;
    }
    collective_try(*comm, give_up);
    publish(*comm, files);
  });
}

}  // namespace pnpbs::io
