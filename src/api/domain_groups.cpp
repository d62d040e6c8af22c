// SPDX-License-Identifier: BSD-3-Clause
// C interface: named groups of domains, and the mesh files that contain them.
#include <iterator>
#include <map>

#include "api/domain_calls.hpp"
#include "api/sphere_points.hpp"
#include "domain/from_files.hpp"
#include "domain/given_values.hpp"
#include "formats/file_dimension.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

namespace {

const std::map<GroupTag, std::string>& names_of(const DomainObject& object) {
  return object.plane ? object.plane->names().all() : object.volume->names().all();
}

GroupTag group_from(const DomainObject& object, int32_t dim, int32_t tag) {
  const int32_t most = object.plane ? 2 : 3;
  if (dim < 0 || dim > most)
    throw Error(ErrorKind::argument, "argument dim = " + std::to_string(dim) + " is not in 0 .. " +
                                         std::to_string(most));
  given_values::require_tag("argument tag", tag);
  return {dim, tag};
}

}  // namespace

pnpbs_status pnpbs_domain_read_msh(pnpbs_domain domain, const char* path, double feature_angle) {
  return change_domain(domain, [&](DomainObject& object) {
    require_pointer(path, "path");
    given_values::require_angle("feature_angle", feature_angle);
    require_no_sphere(sphere_of(object), "domain", "meshes are read");
    const MshMesh mesh = read_msh(path);
    visit_dimension(object, [&](auto& d) { add_msh(d, mesh, feature_angle); });
  });
}

pnpbs_status pnpbs_file_dimension(const char* path, int32_t* dim) {
  return guarded([&] {
    require_pointer(path, "path");
    require_pointer(dim, "dim");
    *dim = file_dimension(path);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_domain_set_role(pnpbs_domain domain, int32_t tag, int32_t role) {
  return change_volume(
      domain, [&](VolumeDomain& volume) { volume.set_role(tag, surface_role_from(role)); });
}

pnpbs_status pnpbs_domain_set_tag_name(pnpbs_domain domain, int32_t dim, int32_t tag,
                                       const char* name) {
  return change_domain(domain, [&](DomainObject& object) {
    require_pointer(name, "name");
    if (*name == '\0') throw Error(ErrorKind::argument, "argument name is empty");
    visit_dimension(object, [&](auto& d) { d.names().set(group_from(object, dim, tag), name); });
  });
}

pnpbs_status pnpbs_domain_tag_name_count(pnpbs_domain domain, int32_t* count) {
  return guarded(domain, [&](DomainObject& object) {
    require_pointer(count, "count");
    *count = static_cast<int32_t>(names_of(object).size());
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_domain_get_tag_name(pnpbs_domain domain, int32_t index, int32_t* dim,
                                       int32_t* tag, const char** name) {
  return guarded(domain, [&](DomainObject& object) {
    const auto& names = names_of(object);
    if (index < 0 || static_cast<std::size_t>(index) >= names.size())
      throw Error(ErrorKind::argument, "argument index = " + std::to_string(index) +
                                           "; the domain has " + std::to_string(names.size()) +
                                           " names of tags");
    const auto& [group, text] = *std::next(names.begin(), index);
    if (dim) *dim = group.dimension;
    if (tag) *tag = group.tag;
    if (name) *name = text.c_str();
    return PNPBS_OK;
  });
}
