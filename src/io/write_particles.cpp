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
                     const std::vector<FileWish>& wishes,
                     const std::function<bool(double)>& asks_to_stop) {
  double done = 0;
  const double all = static_cast<double>(wishes.size());
  const auto give_up_if_asked = [&] {
    if (asks_to_stop && asks_to_stop(done == all ? 1 : done / all))
      throw Error(ErrorKind::stopped, "stopped by the monitor; no file was written");
  };
  agreed(*comm, [&] {
    require_formats_of_points(wishes);
    require_hdf5_for(wishes, *comm);
    require_same_fields(*comm, fields);
    require_fields_for(wishes, fields);
    const ParticlesById nodes(*comm, particles, names, fields);
    std::vector<std::unique_ptr<SharedFile>> files;
    for (const FileWish& wish : wishes) {
      SharedFile& file =
          *files.emplace_back(std::make_unique<SharedFile>(comm, wish.path, give_up_if_asked));
      wish.format->write(nodes, file);
      file.close();
      ++done;
    }
    agreed(*comm, give_up_if_asked);
    publish(*comm, files);
  });
}

}  // namespace pnpbs::io
