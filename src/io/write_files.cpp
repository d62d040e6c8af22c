// SPDX-License-Identifier: BSD-3-Clause
#include "io/write_files.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/error.hpp"
#include "io/hdf5.hpp"
#include "io/node_source.hpp"
#include "io/nodes_by_id.hpp"
#include "io/particle_fields.hpp"
#include "io/rows.hpp"
#include "results/element_regions.hpp"
#include "results/results.hpp"

namespace pnpbs::io {
namespace {

// A source with this rank's nodes, elements and facets and the ghosts that these refer to. It is
// numbered by itself.
template <int Dim>
class RankPiece : public NodeSource {
 public:
  // Includes the ghosts that elements and facets refer to. prepare() of rows.hpp must have been
  // called. `fields` need values at ghosts. Local.
  RankPiece(const Results<Dim>& results, bool elements, const std::vector<OutputField>& fields);

  // The iterations are local.
  void for_nodes(const std::function<void(const NodeRows&)>& visit) const override;
  void for_field(std::size_t field,
                 const std::function<void(const FieldRows&)>& visit) const override;
  void for_elements(const std::function<void(const ElementRows&)>& visit) const override;
  void for_facets(const std::function<void(const FacetRows&)>& visit) const override;

 private:
  // Includes the node if it is a ghost that has no number yet.
  void know(std::int64_t place);
  std::int64_t number(std::int64_t place) const {
    return place < owned_ ? place : number_[static_cast<std::size_t>(place - owned_)];
  }
  std::int64_t place_of_number(std::int64_t number) const {
    return number < owned_ ? number : ghosts_[static_cast<std::size_t>(number - owned_)];
  }
  // Calls visit(begin, end) for windows of the owned nodes.
  template <class Visit>
  void for_windows(const Visit& visit) const;

  const Results<Dim>& results_;
  std::int64_t owned_;
  // Included ghosts, in the order in which elements and facets refer to them.
  std::vector<std::int64_t> ghosts_;  // indices in the results
  std::vector<std::int64_t> number_;  // number of each ghost of the level; -1: not included
};

template <int Dim>
RankPiece<Dim>::RankPiece(const Results<Dim>& results, bool elements,
                          const std::vector<OutputField>& fields)
    : results_(results),
      owned_(results.count()),
      number_(static_cast<std::size_t>(results.level().nodes.count - owned_), -1) {
  contents_.dimension = Dim;
  contents_.coordinates = results.coordinates();
  contents_.is_piece = true;
  contents_.fields = &fields;
  contents_.with_elements = elements;
  contents_.cells = cells_of(results, elements);
  contents_.with_regions =
      contents_.cells == Cells::elements && results.level().geometry.domain().regions();
  if (elements) {
    results.for_elements([&](const auto& places) {
      ++contents_.elements;
      for (const std::int64_t place : places) know(place);
    });
    results.for_facets_without_tags([&](const auto& places) {
      ++contents_.facets;
      for (const std::int64_t place : places) know(place);
    });
  }
  contents_.nodes = owned_ + static_cast<std::int64_t>(ghosts_.size());
}

template <int Dim>
void RankPiece<Dim>::know(std::int64_t place) {
  if (place < owned_) return;
  std::int64_t& number = number_[static_cast<std::size_t>(place - owned_)];
  if (number >= 0) return;
  number = owned_ + static_cast<std::int64_t>(ghosts_.size());
  ghosts_.push_back(place);
}

template <int Dim>
void RankPiece<Dim>::for_nodes(const std::function<void(const NodeRows&)>& visit) const {
  const Nodes<Dim>& nodes = results_.level().nodes;
  for (std::int64_t begin = 0; begin < contents_.nodes; begin += kWindow) {
    NodeRows rows;
    rows.first = begin;
    for (std::int64_t k = begin; k < std::min(begin + kWindow, contents_.nodes); ++k) {
      const std::int64_t i = results_.node_at(place_of_number(k));
      const Point<3> x = results_.point_in_space(i);
      rows.x.insert(rows.x.end(), x.begin(), x.begin() + contents_.coordinates);
      rows.ids.push_back(nodes.id(i));
      rows.tags.push_back(nodes.tag(i));
      rows.spacing.push_back(results_.spacing_at(i));
      rows.ghosts.push_back(k >= owned_);
    }
    visit(rows);
  }
}

template <int Dim>
void RankPiece<Dim>::for_field(std::size_t field,
                               const std::function<void(const FieldRows&)>& visit) const {
  const OutputField& of = (*contents_.fields)[field];
  for (std::int64_t begin = 0; begin < contents_.nodes; begin += kWindow) {
    FieldRows rows;
    rows.first = begin;
    for (std::int64_t k = begin; k < std::min(begin + kWindow, contents_.nodes); ++k) {
      const auto values =
          of.values.begin() + place_of_number(k) * static_cast<std::ptrdiff_t>(of.components);
      rows.values.insert(rows.values.end(), values, values + of.components);
    }
    visit(rows);
  }
}

template <int Dim>
template <class Visit>
void RankPiece<Dim>::for_windows(const Visit& visit) const {
  for (std::int64_t begin = 0; begin < owned_; begin += kWindow)
    visit(begin, std::min(begin + kWindow, owned_));
}

template <int Dim>
void RankPiece<Dim>::for_elements(const std::function<void(const ElementRows&)>& visit) const {
  std::int64_t before = 0;
  ElementRegions<Dim> region_of(results_);
  for_windows([&](std::int64_t begin, std::int64_t end) {
    ElementRows rows;
    rows.first = before;
    results_.for_elements(begin, end, [&](const auto& places) {
      for (const std::int64_t place : places) rows.nodes.push_back(number(place));
      rows.quality.push_back(element_quality(results_, places));
      if (contents_.with_regions) rows.regions.push_back(region_of(places));
    });
    before += static_cast<std::int64_t>(rows.quality.size());
    visit(rows);
  });
}

template <int Dim>
void RankPiece<Dim>::for_facets(const std::function<void(const FacetRows&)>& visit) const {
  FacetRows rows;
  const auto add = [&](const auto& places, std::int32_t tag) {
    for (const std::int64_t place : places) rows.nodes.push_back(number(place));
    rows.tags.push_back(tag);
    rows.quality.push_back(facet_quality(results_, places));
  };
  if constexpr (Dim == 2) {
    results_.for_boundary_facets(add);
    visit(rows);
  } else {
    std::int64_t before = 0;
    for_windows([&](std::int64_t begin, std::int64_t end) {
      rows = FacetRows();
      rows.first = before;
      results_.for_boundary_facets(begin, end, add);
      results_.for_inner_facets(begin, end, add);
      before += static_cast<std::int64_t>(rows.tags.size());
      visit(rows);
    });
  }
}

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorKind::argument, what); }

const Format& format_of(const std::string& path, const std::string& name) {
  const Format* format = name.empty() ? format_by_extension(path) : format_by_name(name);
  if (format) return *format;
  if (name.empty())
    refuse("'" + path + "' has no extension of a known format; it should end in one of " +
           list_of_formats() + "; pictures are written by the command (pnpbs --output)");
  refuse("unknown format \"" + name + "\"; known are " + list_of_formats());
}

std::string with_extension(const std::string& path, const char* extension) {
  return std::filesystem::path(path).replace_extension(extension).string();
}

// Throws unless the path can be a regular file, which all ranks write concurrently.
void require_result_indices(const std::string& path, const Format& format) {
  const std::string what = std::string("a .") + format.name + " file ";
  std::error_code error;
  if (path == "-") refuse(what + "cannot go to standard output; use vtu there");
  if (std::filesystem::is_other(path, error))
    refuse(what + "must be a regular file, no stream and no device: '" + path + "'");
}

// Adds the request for the file of arrays of a .xdmf file. Throws if its name has a colon, which
// separates file and array in XDMF.
// The name differs only in the extension, as DOLFINx expects.
void add_heavy_data(const FileRequest& of, std::vector<FileRequest>& requests) {
  const std::string& path = of.path;
  const std::string heavy = heavy_data_path(path);
  if (std::filesystem::path(heavy).filename().string().find(':') != std::string::npos)
    refuse("XDMF cannot refer to a file with ':' in its name, as '" + heavy +
           "' would have beside '" + path + "': choose another name");
  requests.push_back({heavy, &heavy_data_format(), of.order, of.facets});
}

void require_possible(const std::string& path, const Format& format, int order, int dimension) {
  const bool elements = order > 0;
  if (format.of == Of::bodies && dimension == 2)
    refuse(std::string("a .") + format.name + " file is for bodies, not for the plane: '" + path +
           "'");
  if (format.of == Of::triangles && dimension == 3)
    refuse(std::string("a .") + format.name +
           " file is for triangles in the plane or on a sphere, " + "not for bodies: '" + path +
           "'");
  if (format.in_pieces() && path == "-")
    refuse("a file in pieces cannot go to standard output; use vtu instead of pvtu");
  if (format.by_hdf5) require_result_indices(path, format);
  if (elements && (format.elements == Elements::never || format.elements == Elements::regions))
    refuse(std::string("a .") + format.name + " file cannot contain elements: '" + path + "'");
  if (order == 2 && !format.second_order)
    refuse(std::string("a .") + format.name + " file cannot contain elements of second order: '" +
           path + "'; .msh, .msh2, .vtu and .vtkhdf files can");
  if (elements && format.elements == Elements::beside && path == "-")
    refuse(
        "elements need a second file, which standard output does not have: request the format ele "
        "there");
}

// Throws unless a file of this format can contain elements with cracks.
void require_cracks(const std::string& path, const Format& format, int order) {
  if (!format.second_order)  // other formats list boundaries, or are in pieces
    refuse(std::string("a .") + format.name + " file cannot contain elements with cracks: '" +
           path + "'; .msh, .msh2, .vtu and .vtkhdf files can");
  if (order == 2) refuse("elements of second order cannot have cracks: '" + path + "'");
}

// Throws unless a file of this format can contain elements of a periodic domain.
void require_periodic(const std::string& path, const Format& format, int order, bool has_cracks) {
  const auto refuse_it = [&](const std::string& what) {
    throw Error(ErrorKind::unsupported, what + ": '" + path + "'");
  };
  if (format.in_pieces() || format.write == write_gr3 || format.write == write_2dm)
    refuse_it(std::string("a .") + format.name +
              " file cannot contain the elements of a periodic domain; .msh and .vtu files can");
  if (order == 2) refuse_it("files have no elements of second order of a periodic domain");
  if (has_cracks) refuse_it("there are no cracks in the elements of a periodic domain");
}

// Returns whether a second file can be placed beside this path: not for streams and devices.
bool has_room_beside(const std::string& path) {
  std::error_code error;
  return path != "-" && !path.starts_with("/dev/") && !std::filesystem::is_other(path, error);
}

// The files of one call of write_files().
template <int Dim>
class Writing {
 public:
  Writing(const Monitoring& monitoring, Results<Dim>& results, const OutputFields& fields,
          std::size_t files)
      : monitoring_(monitoring), results_(results), fields_(fields), expected_(files) {}

  void add(const FileRequest& request) {
    if (request.format->write_cells) {
      add_grid(request);
    } else if (request.format->write) {
      add_file(request);
    } else {
      add_piece(request);
      add_list_of_pieces(request);
    }
    ++done_;
  }

  // Publishes the files of all ranks, or none.
  void publish() {
    collective_try(*comm(), [&] { give_up_if_asked(); });
    io::publish(*comm(), files_);
  }

 private:
  const std::shared_ptr<const Communicator>& comm() const { return results_.ranks(); }

  SharedFile& open(const std::shared_ptr<const Communicator>& ranks, const std::string& path) {
    return *files_.emplace_back(
        std::make_unique<SharedFile>(ranks, path, [this] { give_up_if_asked(); }));
  }

  void add_file(const FileRequest& request) {
    std::optional<NodesById<Dim>>& nodes = by_order_[static_cast<std::size_t>(request.order)];
    if (!nodes)
      nodes.emplace(results_, request.order,
                    request.order == 2 ? fields_with_ghosts() : fields_.all());
    SharedFile& file = open(comm(), request.path);
    if (request.facets)
      request.format->write(FacetGrid(*nodes), file);
    else
      request.format->write(*nodes, file);
    file.close();
  }

  // Returns the fields with values at ghosts. Collective.
  const std::vector<OutputField>& fields_with_ghosts() {
    if (fields_with_ghosts_.empty()) fields_with_ghosts_ = fields_.with_ghosts(results_);
    return fields_with_ghosts_;
  }

  void add_grid(const FileRequest& request) {
    if constexpr (Dim == 2) {
      if (!grid_) grid_ = make_sphere_grid(results_);
      SharedFile& file = open(comm(), request.path);
      request.format->write_cells(*grid_, file);
      file.close();
    }
  }

  // Writes the piece of each rank. If one rank throws, all ranks throw.
  void add_piece(const FileRequest& request) {
    prepare(results_, request.order > 0);
    fields_with_ghosts();
    collective_try(*comm(), [&] {
      const RankPiece<Dim> piece(results_, request.order > 0, fields_with_ghosts_);
      like_ = piece.contents();
      SharedFile& file = open(serial_communicator(), piece_path(request.path, comm()->rank()));
      if (request.facets) {
        const FacetGrid facets(piece);
        like_ = facets.contents();
        write_vtu(facets, file);
      } else {
        write_vtu(piece, file);
      }
      file.close();
    });
  }

  void add_list_of_pieces(const FileRequest& request) {
    std::vector<std::string> pieces;
    for (int rank = 0; rank < comm()->size(); ++rank)
      pieces.push_back(piece_path(request.path, rank));
    SharedFile& file = open(comm(), request.path);
    write_pvtu(pieces, like_, file);
    file.close();
  }

  void give_up_if_asked() const {
    io::give_up_if_asked(
        [this](double fraction) { return monitoring_.requests_stop(fraction, nodes_); }, done_,
        expected_);
  }

  const Monitoring& monitoring_;
  Results<Dim>& results_;
  const OutputFields& fields_;
  std::vector<OutputField> fields_with_ghosts_;  // computed for the first file that needs them
  const std::int64_t nodes_ = results_.global_count();
  std::size_t expected_, done_ = 0;
  std::array<std::optional<NodesById<Dim>>, 3> by_order_;  // sources by the order of their elements
  std::unique_ptr<SphereGrid> grid_;                       // built for the first file of cells
  Contents like_;                                          // contents of this rank's piece
  std::vector<std::unique_ptr<SharedFile>> files_;
};

}  // namespace

void require_fields_for(const std::vector<FileRequest>& requests,
                        const std::vector<OutputField>& fields) {
  for (const FileRequest& request : requests)
    for (const std::string_view name : request.format->fields)
      if (!has_particle_field(fields, name))
        refuse(std::string("a .") + request.format->name + " file needs an output field '" +
               std::string(name) + "' with one component: '" + request.path + "'");
}

void require_hdf5_for(const std::vector<FileRequest>& requests, const Communicator& comm) {
  if (std::ranges::none_of(requests,
                           [](const FileRequest& request) { return request.format->by_hdf5; }))
    return;
  collective_try(comm, [&] {
    if (comm.rank() == 0) hdf5::require_hdf5();  // rank 0 creates the files
  });
}

Requested requested_of(Placement& placement) {
  const GeometryKind kind = placement.results().kind();
  return {placement.dimension(), kind != GeometryKind::surface, kind,
          !placement.results().crack_tags().empty(),
          placement.results().has_nodes() &&
              visit_dimension(placement.results(), [](const auto& results) {
                return results.level().nodes.cell.any();
              })};
}

void give_up_if_asked(const AsksToStop& requests_stop, std::size_t done, std::size_t files) {
  const double fraction =
      done == files ? 1 : static_cast<double>(done) / static_cast<double>(files);
  if (requests_stop && requests_stop(fraction))
    throw Error(ErrorKind::stopped, "stopped by the monitor; no file was written");
}

void publish(const Communicator& comm, std::span<const std::unique_ptr<SharedFile>> files) {
  std::vector<OutputFile*> own;
  for (const auto& file : files)
    if (file->own()) own.push_back(file->own());
  publish_together(own, [&](const std::function<void()>& step) { collective_try(comm, step); });
}

void add_request(const std::string& path, const std::string& format_name, int order,
                 const Requested& of, std::vector<FileRequest>& requests) {
  if (path.empty()) refuse("the name of a file is empty");
  const Format& format = format_of(path, format_name);
  require_possible(path, format, order, of.dimension);
  const bool elements = order > 0;
  if (format.write == write_gadget && of.kind == GeometryKind::sphere)
    refuse("a .hdf5 file is for gas in the plane or in space, not on a sphere: '" + path + "'");
  if (format.of == Of::spheres && of.kind != GeometryKind::sphere)
    refuse(std::string("a .") + format.name + " file is for the cells of a sphere: '" + path + "'");
  if (of.kind == GeometryKind::surface && format.of == Of::bodies && !format.fields.empty())
    refuse(std::string("a .") + format.name + " file is for bodies, not for surfaces alone: '" +
           path + "'");
  const bool holds_elements =
      format.elements == Elements::always ||
      (format.elements == Elements::regions && of.has_elements) ||
      (elements && (format.elements == Elements::on_request || format.elements == Elements::grid));
  const int held = holds_elements ? std::max(order, 1) : 0;
  if (of.is_periodic && held > 0) require_periodic(path, format, held, of.has_cracks);
  if (of.has_cracks && held > 0) require_cracks(path, format, held);
  std::vector<FileRequest> grids{{path, &format, held}};
  if (elements && format.elements == Elements::grid && of.has_elements && has_room_beside(path))
    grids.push_back({facets_path(path), &format, held, true});
  for (const FileRequest& grid : grids) {
    requests.push_back(grid);
    if (format.write == write_xdmf) add_heavy_data(grid, requests);
  }
  if (!elements || format.elements != Elements::beside) return;
  requests.push_back({with_extension(path, "ele"), format_by_name("ele"), 1});
  if (of.dimension == 3)
    requests.push_back({with_extension(path, "face"), format_by_name("face"), 1});
}

std::string piece_path(const std::string& path, int rank) {
  const std::filesystem::path whole(path);
  return (whole.parent_path() / (whole.stem().string() + "_" + std::to_string(rank) + ".vtu"))
      .string();
}

void write_files(Placement& placement, const OutputFields& fields,
                 const std::vector<FileRequest>& requests) {
  const Communicator& comm = placement.communicator();
  // If one rank fails in any step, all ranks throw.
  collective_try(comm, [&] {
    require_hdf5_for(requests, comm);
    fields.require_current(placement.results());
    // Throws if there are no nodes, which is reported before missing fields.
    placement.results().prepare_order();
    require_fields_for(requests, fields.all());
    visit_dimension(placement.results(), [&]<int Dim>(Results<Dim>& results) {
      Writing<Dim> writing(placement.monitoring(), results, fields, requests.size());
      for (const FileRequest& request : requests) writing.add(request);
      writing.publish();
    });
  });
}

}  // namespace pnpbs::io
