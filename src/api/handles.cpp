// SPDX-License-Identifier: BSD-3-Clause
#include "api/handles.hpp"

#include <atomic>

namespace pnpbs::api {

std::uintptr_t next_key() {
  static std::atomic<std::uintptr_t> counter{0};
  // Keys are large numbers, because uninitialized handles often contain small integers.
  return 0x50420000u + ++counter;
}

// Registries are never destroyed. Objects may outlive the static destructors of this library if the
// host destroys them at exit, and Kokkos Views must not be freed after Kokkos has ended.
Registry<Context, pnpbs_context>& contexts() {
  static auto* registry = new Registry<Context, pnpbs_context>;
  return *registry;
}
Registry<DomainObject, pnpbs_domain>& domains() {
  static auto* registry = new Registry<DomainObject, pnpbs_domain>;
  return *registry;
}
Registry<PlacementObject, pnpbs_placement>& placements() {
  static auto* registry = new Registry<PlacementObject, pnpbs_placement>;
  return *registry;
}
Registry<TransferObject, pnpbs_transfer>& transfers() {
  static auto* registry = new Registry<TransferObject, pnpbs_transfer>;
  return *registry;
}
Registry<MeshObject, pnpbs_mesh>& meshes() {
  static auto* registry = new Registry<MeshObject, pnpbs_mesh>;
  return *registry;
}
Registry<VoronoiObject, pnpbs_voronoi>& voronois() {
  static auto* registry = new Registry<VoronoiObject, pnpbs_voronoi>;
  return *registry;
}
Registry<ParticlesObject, pnpbs_particles>& all_particles() {
  static auto* registry = new Registry<ParticlesObject, pnpbs_particles>;
  return *registry;
}

namespace {

template <class Object>
std::shared_ptr<Object> require_live(std::shared_ptr<Object> object, const char* kind) {
  if (!object)
    throw Error(ErrorKind::handle, std::string("the ") + kind +
                                       " handle is not live: it was never created, or it was "
                                       "destroyed");
  return object;
}

}  // namespace

std::shared_ptr<Context> require(pnpbs_context handle) {
  return require_live(contexts().find(handle), "context");
}
std::shared_ptr<DomainObject> require(pnpbs_domain handle) {
  return require_live(domains().find(handle), "domain");
}
std::shared_ptr<PlacementObject> require(pnpbs_placement handle) {
  return require_live(placements().find(handle), "placement");
}
std::shared_ptr<TransferObject> require(pnpbs_transfer handle) {
  return require_live(transfers().find(handle), "transfer");
}
std::shared_ptr<MeshObject> require(pnpbs_mesh handle) {
  return require_live(meshes().find(handle), "mesh");
}
std::shared_ptr<VoronoiObject> require(pnpbs_voronoi handle) {
  return require_live(voronois().find(handle), "voronoi");
}
std::shared_ptr<ParticlesObject> require(pnpbs_particles handle) {
  return require_live(all_particles().find(handle), "particles");
}

}  // namespace pnpbs::api
