// SPDX-License-Identifier: BSD-3-Clause
#include "io/output_fields.hpp"

#include <algorithm>
#include <string_view>

#include "base/error.hpp"
#include "base/mixed_hash.hpp"
#include "base/small_letters.hpp"
#include "comm/ghost_update.hpp"

namespace pnpbs::io {

namespace {

constexpr std::size_t kLongestFieldName = 63;
// Components of a tensor in space, which is also the largest in Gmsh.
constexpr std::int64_t kMaxComponents = 9;

[[noreturn]] void refuse_field(const std::string& what) { throw Error(ErrorKind::argument, what); }

bool is_allowed(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-';
}

// Throws unless the name is valid in XML, in HDF5 paths and in quotation marks, and is not used by
// the library.
void require_name(const std::string& name) {
  if (name.empty() || name.size() > kLongestFieldName || !std::ranges::all_of(name, is_allowed))
    refuse_field("argument name = \"" + name + "\"; an output field has a name of 1 to " +
                 std::to_string(kLongestFieldName) + " letters, digits, '_' and '-'");
  constexpr std::string_view ours[] = {"id",      "tag",     "spacing",
                                       "quality", "partner", "vtkghosttype"};
  if (std::ranges::find(ours, to_lower_case(name)) != std::end(ours))
    refuse_field("argument name = \"" + name +
                 "\" is the name of an array that files always contain; choose "
                 "another");
}

// Returns a hash of the ids and positions of this rank's nodes, in their order.
std::uint64_t hash_of_nodes(NodalResults& results) {
  results.prepare_order();
  const NodeColumns nodes = results.nodes();
  std::uint64_t hash = 0;
  const std::int64_t owned = results.count();
  for (std::int64_t place = 0; place < owned; ++place) {
    const std::int64_t i = results.node_at(place);
    hash = mixed(hash ^ static_cast<std::uint64_t>(nodes.id(i)));
    for (int axis = 0; axis < results.coordinates(); ++axis)
      hash = mixed_with(hash, nodes.x[static_cast<std::size_t>(axis)](i));
  }
  return hash;
}

}  // namespace

void require_new_field(const std::vector<OutputField>& all, const std::string& name, std::int64_t n,
                       std::int64_t owners, const char* called, std::int64_t components,
                       const double* values) {
  require_name(name);
  if (std::ranges::find(all, name, &OutputField::name) != all.end())
    refuse_field("argument name = \"" + name +
                 "\": there is an output field of that name; choose another");
  if (components < 1 || components > kMaxComponents)
    refuse_field("argument components = " + std::to_string(components) +
                 "; an output field has 1 to " + std::to_string(kMaxComponents));
  if (n < owners)
    refuse_field("argument n = " + std::to_string(n) + "; this rank has " + std::to_string(owners) +
                 " " + called + ": give values for each of them");
  if (owners > 0 && !values) refuse_field("argument values is NULL");
}

void require_same_fields(const Communicator& comm, const std::vector<OutputField>& all) {
  std::uint64_t kinds = 0;
  for (const OutputField& field : all) {
    for (const char c : field.name) kinds = mixed(kinds ^ static_cast<unsigned char>(c));
    kinds = mixed(kinds ^ static_cast<std::uint64_t>(field.components + 256));
  }
  if (!comm.same_on_all(kinds))
    refuse_field(
        "the output fields differ between ranks: add the same ones in the same order on all");
}

void OutputFields::add(NodalResults& results, const std::string& name, std::int64_t n,
                       std::int64_t components, const double* values) {
  const std::int64_t owned = results.count();
  require_new_field(all_, name, n, owned, "nodes", components, values);
  all_.push_back({name, components, std::vector<double>(values, values + owned * components),
                  hash_of_nodes(results)});
}

void OutputFields::require_current(NodalResults& results) const {
  const Communicator& comm = results.communicator();
  collective_try(comm, [&] {
    const std::uint64_t hash = all_.empty() ? 0 : hash_of_nodes(results);
    for (const OutputField& field : all_)
      if (field.nodes_hash != hash)
        throw Error(ErrorKind::state,
                    "the output field '" + field.name +
                        "' belongs to nodes that have moved or changed their ranks since it was "
                        "added: clear the output fields, and add it again");
  });
  require_same_fields(comm, all_);
}

std::vector<OutputField> OutputFields::with_ghosts(NodalResults& results) const {
  if (all_.empty()) return {};
  const auto pattern = results.exchange_pattern();
  const auto places = static_cast<std::size_t>(results.held());
  std::vector<OutputField> fields;
  for (const OutputField& field : all_) {
    GhostUpdate update;
    collective_try(results.communicator(), [&] {
      fields.push_back(field);
      fields.back().values.resize(places * static_cast<std::size_t>(field.components));
      update.pack(results.communicator(), pattern, field.components, fields.back().values.data());
    });
    update.start();
    update.wait();
    update.unpack(fields.back().values.data());
  }
  return fields;
}

}  // namespace pnpbs::io
