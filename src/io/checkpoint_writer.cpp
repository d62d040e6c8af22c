// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <type_traits>

#include "base/build_config.hpp"
#include "base/error.hpp"
#include "comm/rank_span.hpp"
#include "io/checkpoint_parts.hpp"
#include "io/file_seal.hpp"
#include "io/hdf5_layout.hpp"
#include "io/output_file.hpp"

namespace pnpbs::io {

namespace {

// The rows of one rank, from row `first` on, of an array that begins at `place`. row(k): its k-th
// record.
template <class Row>
void write_rows(RankFile& file, const Column& column, std::int64_t place, std::int64_t first,
                std::int64_t rows, const Row& row) {
  const std::int64_t size = column.array.row_size();
  const std::size_t given = static_cast<std::size_t>(column.given) * size_of(column.array.type);
  Bytes piece;
  in_pieces(rows, size, [&](std::int64_t from, std::int64_t n) {
    piece.assign(static_cast<std::size_t>(n * size), 0);
    for (std::int64_t k = 0; k < n; ++k) {
      const auto record = row(from + k);
      std::memcpy(piece.data() + k * size, reinterpret_cast<const char*>(&record) + column.offset,
                  given);
    }
    file.write_at(place + (first + from) * size, piece);
  });
}

// A node as a cell of its own.
struct Vertex {
  std::int64_t number;
  std::uint8_t type = 1;  // VTK_VERTEX
};

template <int Dim>
class CheckpointWriter {
 public:
  CheckpointWriter(PlacementOf<Dim>& placement, const std::string& path)
      : comm_(*placement.ranks()), saved_(placement.saved()), path_(path), output_(path) {}

  void write() {
    rows_ = span_of(comm_, saved_.owned.size());
    if (saved_.state.spacing_saved) measure_patch();
    agreed(comm_, [&] {
      if (comm_.rank() == 0) lay_out();
    });
    share(comm_, places_);
    Bytes name;
    if (comm_.rank() == 0) {
      const std::string aside = output_.name_aside();
      name.assign(aside.begin(), aside.end());
    }
    comm_.broadcast(name, 0);
    const std::unique_ptr<RankFile> file =
        comm_.open_file(std::string(name.begin(), name.end()), quoted_checkpoint(path_));
    agreed(comm_, [&] {
      write_own(*file);
      file->close();
    });
    agreed(comm_, [&] {
      if (comm_.rank() == 0) flush();
    });
    std::vector<OutputFile*> own;
    if (comm_.rank() == 0) own.push_back(&output_);
    publish_together(own, [this](const std::function<void()>& step) { agreed(comm_, step); });
  }

 private:
  // The arrays that ranks write rows of, in this order; empty ones are left out.
  std::vector<hdf5::Array> arrays() const {
    std::vector<hdf5::Array> all;
    for (const Column& column : node_columns<Dim>(rows_.total)) all.push_back(column.array);
    for (const hdf5::Array& array : vertex_arrays(rows_.total)) all.push_back(array);
    if (saved_.state.spacing_saved) {
      for (const Column& column : patch_node_columns<Dim>(all_patches_.nodes))
        all.push_back(column.array);
      all.push_back(simplex_column<Dim>(all_patches_.simplices).array);
      all.push_back(facet_column<Dim>(all_patches_.facets).array);
    }
    return all;
  }

  // What the ranks hold of the spacing's nodes. Collective.
  void measure_patch() {
    const Patch<Dim>& patch = *saved_.patch;
    Bytes mine;
    pack(mine, PatchSizes{std::ssize(patch.nodes), std::ssize(patch.simplices),
                          std::ssize(patch.border)});
    int rank = 0;
    for_records<PatchSizes>({comm_.allgather(mine)}, [&](const PatchSizes& sizes) {
      if (rank++ == comm_.rank()) patches_before_ = all_patches_;
      all_patches_.nodes += sizes.nodes;
      all_patches_.simplices += sizes.simplices;
      all_patches_.facets += sizes.facets;
      for (const std::int64_t size : {sizes.nodes, sizes.simplices, sizes.facets})
        patch_sizes_.push_back(size);
    });
    patch_checksum_ = comm_.allreduce_sum(checksum_of(patch));
  }

  // On rank 0, by HDF5: everything but the rows.
  void lay_out() {
    output_.check();
    if (!output_.written_aside())
      throw Error(ErrorKind::argument, "argument path = \"" + path_ +
                                           "\": a checkpoint is a file of its own, no stream and "
                                           "no device");
    output_.close(output_.open());
    const std::vector<hdf5::Array> all = arrays();
    places_ = io::lay_out(output_, quoted_checkpoint(path_), all,
                          [this](hdf5::NewFile& file) { add_state(file); });
    std::vector<Extent> rows;
    for (std::size_t k = 0; k < all.size(); ++k)
      if (all[k].rows > 0) rows.push_back({places_[k], all[k].rows * all[k].row_size()});
    add_seal(output_.name_aside(), quoted_checkpoint(path_), std::move(rows));
  }

  void add_state(hdf5::NewFile& file) const {
    begin_vtk_grid(file, rows_.total, rows_.total, rows_.total);
    file.add_group(kOwn);
    file.set(kOwn, "format", kCheckpointFormat);
    file.set(kOwn, "written_by", std::string("PNPBS ") + PNPBS_PROJECT_VERSION);
    for_fields(saved_.state,
               [&](const char* field, const auto& value) { set(file, field, value); });
    for_tables(saved_.state, [&](const char* name, const std::vector<double>& numbers) {
      if (!numbers.empty()) file.add_reals(table_path(name), numbers);
    });
    if (!saved_.state.spacing_saved) return;
    file.add_group(kSpacing);
    set(file, "spacing_checksum", patch_checksum_);
    file.add(std::string(kSpacing) + "/parts", patch_sizes_);
  }

  template <class Value>
  static void set(hdf5::NewFile& file, const char* field, const Value& value) {
    if constexpr (std::is_same_v<Value, std::uint64_t>)
      file.set(kOwn, field, static_cast<std::int64_t>(value));
    else
      file.set(kOwn, field, value);
  }

  void write_own(RankFile& file) const {
    std::size_t next = 0;
    for (const Column& column : node_columns<Dim>(rows_.total))
      write_rows(file, column, places_[next++], rows_.first, rows_.count,
                 [this](std::int64_t k) { return saved_.node(k); });
    const std::vector<hdf5::Array> vertices = vertex_arrays(rows_.total);
    const auto vertex = [this](std::int64_t k) { return Vertex{rows_.first + k}; };
    const std::array<std::size_t, 3> offsets{offsetof(Vertex, type), offsetof(Vertex, number),
                                             offsetof(Vertex, number)};
    for (std::size_t k = 0; k < offsets.size(); ++k) {
      const bool last = k == 2 && comm_.rank() == comm_.size() - 1;  // where the last cell ends
      write_rows(file, {vertices[k], 1, offsets[k]}, places_[next++], rows_.first,
                 rows_.count + last, vertex);
    }
    if (!saved_.state.spacing_saved) return;
    const Patch<Dim>& patch = *saved_.patch;
    const auto rows_from = [](const auto& rows) {
      return [&rows](std::int64_t k) { return rows[static_cast<std::size_t>(k)]; };
    };
    for (const Column& column : patch_node_columns<Dim>(all_patches_.nodes))
      write_rows(file, column, places_[next++], patches_before_.nodes, std::ssize(patch.nodes),
                 rows_from(patch.nodes));
    write_rows(file, simplex_column<Dim>(all_patches_.simplices), places_[next++],
               patches_before_.simplices, std::ssize(patch.simplices), rows_from(patch.simplices));
    write_rows(file, facet_column<Dim>(all_patches_.facets), places_[next++],
               patches_before_.facets, std::ssize(patch.border), rows_from(patch.border));
  }

  // On the disk before it replaces another one.
  void flush() const {
    const int descriptor = ::open(output_.name_aside(), O_RDONLY | O_CLOEXEC);
    const bool done = descriptor >= 0 && ::fsync(descriptor) == 0;
    const int error = errno;
    if (descriptor >= 0) ::close(descriptor);
    if (!done && error != EINVAL && error != EROFS)
      throw Error(ErrorKind::file,
                  "cannot write " + quoted_checkpoint(path_) + ": " + std::strerror(error));
  }

  const Communicator& comm_;
  const Saved<Dim> saved_;
  std::string path_;
  OutputFile output_;  // rank 0's
  RankSpan rows_;
  PatchSizes patches_before_, all_patches_;
  std::vector<std::int64_t> patch_sizes_;
  std::uint64_t patch_checksum_ = 0;
  std::vector<std::int64_t> places_;  // of arrays()
};

}  // namespace

template <int Dim>
void write_checkpoint_of(PlacementOf<Dim>& placement, const std::string& path) {
  CheckpointWriter<Dim>(placement, path).write();
}

template void write_checkpoint_of(PlacementOf<2>& placement, const std::string& path);
template void write_checkpoint_of(PlacementOf<3>& placement, const std::string& path);

}  // namespace pnpbs::io
