// SPDX-License-Identifier: BSD-3-Clause
// The objects behind the handles, and their registries. The value of a handle is a key of a
// registry. Keys are counted up and never used again, so that stale handles are detected.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "api/shape.hpp"
#include "base/error.hpp"
#include "comm/communicator.hpp"
#include "domain/domain.hpp"
#include "io/output_fields.hpp"
#include "mesh/distributed_mesh.hpp"
#include "particles/particles.hpp"
#include "placement/placement_impl.hpp"
#include "pnpbs/pnpbs.h"
#include "settings/options.hpp"
#include "transfer/field_transfer.hpp"
#include "voronoi/voronoi_cells.hpp"

namespace pnpbs::api {

// The last error that a caller can query.
struct LastError {
  MessageText message;
  ErrorReason reason = ErrorReason::other;
};

// The object of a context handle.
struct Context {
  std::shared_ptr<Communicator> communicator;
  Options options;
  LastError last_error;
  std::string returned_text;  // the last string returned to the caller
  bool computing = false;     // a call that may run callbacks is in progress
};

// A domain, of which either `plane` or `volume` is set. Domains on a sphere have `plane`.
struct DomainObject {
  std::shared_ptr<Context> context;
  std::shared_ptr<PlaneDomain> plane;
  std::shared_ptr<VolumeDomain> volume;
  // Shape queries of the domain in its present state, created on the first query.
  std::shared_ptr<DomainShapes<2>> plane_shapes;
  std::shared_ptr<DomainShapes<3>> volume_shapes;
};

// A placement and the fields that its output files contain in addition.
struct PlacementObject {
  std::shared_ptr<Context> context;
  std::unique_ptr<Placement> placement;
  io::OutputFields output_fields{};
};

struct TransferObject {
  std::shared_ptr<Context> context;
  std::unique_ptr<FieldTransfer> transfer;
  double sphere_radius = 0;  // radius of the sphere of its nodes; 0 if they are on none
};

struct MeshObject {
  std::shared_ptr<Context> context;
  std::unique_ptr<const DistributedMesh> mesh;
};

struct VoronoiObject {
  std::shared_ptr<Context> context;
  std::unique_ptr<const VoronoiCells> cells;
};

// Particles and the fields of their output files.
struct ParticlesObject {
  std::shared_ptr<Context> context;
  std::unique_ptr<const Particles> particles;
  std::weak_ptr<PlacementObject> placement;      // its monitor may stop the writing of files
  GroupNames names{};                            // names of tags
  std::vector<io::OutputField> output_fields{};  // the volumes come first
};

// Returns a new key. All keys of the process come from one counter, so that a handle of another
// kind is detected, too.
std::uintptr_t next_key();

// The live objects of one kind. Thread-safe.
template <class Object, class Handle>
class Registry {
 public:
  Handle add(std::shared_ptr<Object> object) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::uintptr_t key = next_key();
    objects_[key] = std::move(object);
    return reinterpret_cast<Handle>(key);
  }
  std::shared_ptr<Object> find(Handle handle) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = objects_.find(reinterpret_cast<std::uintptr_t>(handle));
    return found == objects_.end() ? nullptr : found->second;
  }
  void remove(Handle handle) {
    std::shared_ptr<Object> last;  // declared first, hence destroyed after unlocking
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = objects_.find(reinterpret_cast<std::uintptr_t>(handle));
    if (found == objects_.end()) return;
    last = std::move(found->second);
    objects_.erase(found);
  }
  template <class Visit>
  void for_each(const Visit& visit) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (auto& [key, object] : objects_) visit(*object);
  }

 private:
  std::mutex mutex_;
  std::map<std::uintptr_t, std::shared_ptr<Object>> objects_;
};

Registry<Context, pnpbs_context>& contexts();
Registry<DomainObject, pnpbs_domain>& domains();
Registry<PlacementObject, pnpbs_placement>& placements();
Registry<TransferObject, pnpbs_transfer>& transfers();
Registry<MeshObject, pnpbs_mesh>& meshes();
Registry<VoronoiObject, pnpbs_voronoi>& voronois();
Registry<ParticlesObject, pnpbs_particles>& all_particles();

// Return the object of a handle. Throw Error(ErrorKind::handle) if it is not live.
std::shared_ptr<Context> require(pnpbs_context handle);
std::shared_ptr<DomainObject> require(pnpbs_domain handle);
std::shared_ptr<PlacementObject> require(pnpbs_placement handle);
std::shared_ptr<TransferObject> require(pnpbs_transfer handle);
std::shared_ptr<MeshObject> require(pnpbs_mesh handle);
std::shared_ptr<VoronoiObject> require(pnpbs_voronoi handle);
std::shared_ptr<ParticlesObject> require(pnpbs_particles handle);

}  // namespace pnpbs::api
