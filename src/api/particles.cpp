// SPDX-License-Identifier: BSD-3-Clause
// C interface: particles.
#include "particles/particles.hpp"

#include "api/copy_out.hpp"
#include "api/domain_calls.hpp"
#include "api/file_requests.hpp"
#include "api/placement_calls.hpp"
#include "api/sphere_points.hpp"
#include "io/write_particles.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

namespace {

std::int64_t count_of(const Particles& particles) {
  return static_cast<std::int64_t>(particles.ids.size());
}

template <int Dim>
std::shared_ptr<ParticlesObject> made(const std::shared_ptr<PlacementObject>& placement,
                                      const Domain<Dim>& body) {
  auto made = std::make_shared<ParticlesObject>();
  auto& results = static_cast<Results<Dim>&>(placement->placement->results());
  made->context = placement->context;
  made->placement = placement;
  made->particles = make_particles<Dim>(results, body);
  made->names = results.domain().names();
  made->output_fields.push_back({"volume", 1, made->particles->volumes});
  return made;
}

void require_body(const NodalResults& results) {
  if (results.kind() == GeometryKind::surface)
    throw Error(ErrorKind::argument,
                "argument placement has nodes on surfaces alone: particles need nodes in a body");
}

}  // namespace

pnpbs_status pnpbs_particles_create(pnpbs_placement placement, pnpbs_domain body,
                                    pnpbs_particles* particles) {
  const auto make = [&](PlacementObject& object) {
    NodalResults& results = object.placement->results();
    require_not_periodic(results, "there are no particles");
    std::shared_ptr<DomainObject> within;
    collective_try(results.communicator(), [&] {
      within = body_with(*object.context, results.dimension() == 2, body);
      require_body(results);
      require_no_sphere(sphere_of(object), "placement", "particles are made");
      visit_dimension(*within, [](auto& domain) { domain.check(); });
    });
    const std::shared_ptr<PlacementObject> of = require(placement);
    return within->plane ? made<2>(of, *within->plane) : made<3>(of, *within->volume);
  };
  return collective_create(placement, particles, "particles", all_particles, make);
}

pnpbs_status pnpbs_particles_destroy(pnpbs_particles* particles) {
  return destroy(particles, all_particles);
}

pnpbs_status pnpbs_particles_sizes(pnpbs_particles particles, int32_t* dim, int64_t* count,
                                   int64_t* all) {
  return guarded(particles, [&](ParticlesObject& object) {
    if (dim) *dim = object.particles->dimension;
    if (count) *count = count_of(*object.particles);
    if (all) *all = object.particles->all;
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_particles_figures(pnpbs_particles particles, int64_t* left_out, int64_t* moved,
                                     double* closest) {
  return guarded(particles, [&](ParticlesObject& object) {
    if (left_out) *left_out = object.particles->left_out;
    if (moved) *moved = object.particles->moved;
    if (closest) *closest = object.particles->closest;
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_particles_get(pnpbs_particles particles, int64_t capacity, double* x,
                                 double* volumes, double* spacing, int64_t* ids, int32_t* tags) {
  return guarded(particles, [&](ParticlesObject& object) {
    const Particles& from = *object.particles;
    require_capacity(capacity, count_of(from));
    copy_out(from.x, x);
    copy_out(from.volumes, volumes);
    copy_out(from.spacing, spacing);
    copy_out(from.ids, ids);
    copy_out(from.tags, tags);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_particles_add_output_field(pnpbs_particles particles, const char* name,
                                              int64_t n, int32_t components, const double* values) {
  return guarded(particles, [&](ParticlesObject& object) {
    require_not_in_callback(*object.context);
    require_pointer(name, "name");
    const std::int64_t count = count_of(*object.particles);
    io::require_new_field(object.output_fields, name, n, count, "particles", components, values);
    object.output_fields.push_back(
        {name, components, std::vector<double>(values, values + count * components)});
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_particles_write(pnpbs_particles particles, int32_t n, const char* const* paths,
                                   const char* const* formats) {
  return guarded(particles, [&](ParticlesObject& object) {
    const Computing computing(*object.context);
    const std::shared_ptr<const Communicator> comm = object.context->communicator;
    const std::shared_ptr<PlacementObject> placement = object.placement.lock();
    const auto requests_stop = [&](double fraction) {
      return placement &&
             placement->placement->monitoring().requests_stop(fraction, object.particles->all);
    };
    collective_try(*comm, [&] {
      const std::vector<io::FileRequest> requests =
          requests_of(n, paths, formats, nullptr, {object.particles->dimension});
      require_same_requests(*comm, requests);
      io::write_particles(comm, *object.particles, object.names, object.output_fields, requests,
                          requests_stop);
    });
    return PNPBS_OK;
  });
}
