// SPDX-License-Identifier: BSD-3-Clause
#include "io/write_particles.hpp"

#include "base/error.hpp"
#include "io/particles_by_id.hpp"

namespace pnpbs::io {

namespace {

// Pieces are those of a placement, and these formats have nothing but elements.
void require_formats_of_points(const std::vector<FileWish>& wishes) {
  for (const FileWish& wish : wishes)
    if (!wish.format->write || wish.format->elements == Elements::always)
      throw Error(ErrorKind::argument, std::string("a .") + wish.format->name +
                                           " file has no place for particles: '" + wish.path + "'");
}

}  // namespace

void write_particles(const std::shared_ptr<const Communicator>& comm, const Particles& particles,
                     const GroupNames& names, const std::vector<OutputField>& fields,
                     const std::vector<FileWish>& wishes, const AsksToStop& asks_to_stop) {
  std::size_t done = 0;
  const auto give_up = [&] { give_up_if_asked(asks_to_stop, done, wishes.size()); };
  agreed(*comm, [&] {
    require_formats_of_points(wishes);
    require_hdf5_for(wishes, *comm);
    require_same_fields(*comm, fields);
    require_fields_for(wishes, fields);
    const ParticlesById nodes(*comm, particles, names, fields);
    std::vector<std::unique_ptr<SharedFile>> files;
    for (const FileWish& wish : wishes) {
      SharedFile& file =
          *files.emplace_back(std::make_unique<SharedFile>(comm, wish.path, give_up));
      wish.format->write(nodes, file);
      file.close();
      ++done;
    }
    agreed(*comm, give_up);
    publish(*comm, files);
  });
}

}  // namespace pnpbs::io
