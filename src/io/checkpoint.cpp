// SPDX-License-Identifier: BSD-3-Clause
#include "io/checkpoint.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "base/build_config.hpp"
#include "base/error.hpp"
#include "base/limits.hpp"
#include "comm/communicator.hpp"
#include "comm/rank_span.hpp"
#include "comm/records.hpp"
#include "io/checkpoint_layout.hpp"
#include "io/file_seal.hpp"
#include "io/hdf5_grid.hpp"
#include "io/output_file.hpp"
#include "placement/placement_impl.hpp"

namespace pnpbs::io {
namespace {

// Returns the name of the file for messages.
std::string quoted_checkpoint(const std::string& path) { return "checkpoint '" + path + "'"; }

// Replaces the numbers of all ranks by those of rank 0. Collective.
template <class Number>
void share(const Communicator& comm, std::vector<Number>& numbers) {
  Bytes bytes;
  for (const Number number : numbers) pack(bytes, number);
  comm.broadcast(bytes, 0);
  numbers.clear();
  for_records<Number>(bytes, [&](Number number) { numbers.push_back(number); });
}

// Divides rows into pieces of about 1 MiB and calls visit(first row, number of rows) for each.
template <class Visit>
void in_pieces(std::int64_t rows, std::int64_t row_size, const Visit& visit) {
  constexpr std::int64_t kPiece = 1 << 20;  // size of a write or read. [bytes]
  const std::int64_t most = std::max<std::int64_t>(1, kPiece / row_size);
  for (std::int64_t first = 0; first < rows; first += most)
    visit(first, std::min(most, rows - first));
}

// Writes the rows of this rank, from row `first` on, to an array that begins at offset `place` of
// the file. row(k) returns record k of this rank.
template <class Row>
void write_rows(SharedWriter& file, const Column& column, std::int64_t place, std::int64_t first,
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

// A VTK cell with one node.
struct Vertex {
  std::int64_t number;
  std::uint8_t type = 1;  // VTK's type of a vertex cell
};

// A writer of a checkpoint. All ranks construct it and call write().
template <int Dim>
class CheckpointWriter {
 public:
  CheckpointWriter(PlacementImpl<Dim>& placement, const std::string& path)
      : comm_(*placement.ranks()), saved_(placement.saved()), path_(path), output_(path) {}

  void write() {
    rows_ = span_of(comm_, saved_.owned.size());
    if (saved_.state.spacing_saved) measure_patch();
    collective_try(comm_, [&] {
      if (comm_.rank() == 0) lay_out();
    });
    share(comm_, places_);
    Bytes name;
    if (comm_.rank() == 0) {
      const std::string aside = output_.name_aside();
      name.assign(aside.begin(), aside.end());
    }
    comm_.broadcast(name, 0);
    const std::unique_ptr<SharedWriter> file =
        comm_.open_file(std::string(name.begin(), name.end()), quoted_checkpoint(path_));
    collective_try(comm_, [&] {
      write_own(*file);
      file->close();
    });
    collective_try(comm_, [&] {
      if (comm_.rank() == 0) flush();
    });
    std::vector<OutputFile*> own;
    if (comm_.rank() == 0) own.push_back(&output_);
    publish_together(own,
                     [this](const std::function<void()>& step) { collective_try(comm_, step); });
  }

 private:
  // Returns the arrays whose rows the ranks write, in this order. Empty arrays are left out of the
  // file.
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

  // Collects the sizes and the checksum of the parts of a nodal spacing on all ranks. Collective.
  void measure_patch() {
    const Patch<Dim>& patch = *saved_.patch;
    Bytes mine;
    pack(mine, PatchSizes{std::ssize(patch.nodes), std::ssize(patch.simplices),
                          std::ssize(patch.border)});
    int rank = 0;
    for_records<PatchSizes>(comm_.allgather(mine), [&](const PatchSizes& sizes) {
      if (rank++ == comm_.rank()) patches_before_ = all_patches_;
      all_patches_.nodes += sizes.nodes;
      all_patches_.simplices += sizes.simplices;
      all_patches_.facets += sizes.facets;
      for (const std::int64_t size : {sizes.nodes, sizes.simplices, sizes.facets})
        patch_sizes_.push_back(size);
    });
    patch_checksum_ = comm_.allreduce_sum(checksum_of(patch));
  }

  // Creates the file with everything except the rows, by HDF5. Called on rank 0 only.
  void lay_out() {
    output_.check();
    if (!output_.written_aside())
      throw Error(ErrorKind::argument, "argument path = \"" + path_ +
                                           "\": a checkpoint must be a regular file, no stream "
                                           "and no device");
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

  void write_own(SharedWriter& file) const {
    std::size_t next = 0;
    for (const Column& column : node_columns<Dim>(rows_.total))
      write_rows(file, column, places_[next++], rows_.first, rows_.count,
                 [this](std::int64_t k) { return saved_.node(k); });
    const std::vector<hdf5::Array> vertices = vertex_arrays(rows_.total);
    const auto vertex = [this](std::int64_t k) { return Vertex{rows_.first + k}; };
    const std::array<std::size_t, 3> offsets{offsetof(Vertex, type), offsetof(Vertex, number),
                                             offsetof(Vertex, number)};
    for (std::size_t k = 0; k < offsets.size(); ++k) {
      // The offsets have one more row, the end of the last cell.
      const bool last = k == 2 && comm_.rank() == comm_.size() - 1;
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

  // Flushes the file to the disk, before it replaces an older one.
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
  OutputFile output_;  // used on rank 0
  RankSpan rows_;
  PatchSizes patches_before_, all_patches_;
  std::vector<std::int64_t> patch_sizes_;
  std::uint64_t patch_checksum_ = 0;
  std::vector<std::int64_t> places_;  // offsets of arrays() in the file
};

template <int Dim>
void write_checkpoint_of(PlacementImpl<Dim>& placement, const std::string& path) {
  CheckpointWriter<Dim>(placement, path).write();
}

// A file open for reading on this rank.
class InputFile {
 public:
  InputFile(const std::string& path, std::string name)
      : name_(std::move(name)), descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (descriptor_ < 0) fail(std::strerror(errno));
  }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  void read_at(std::int64_t place, char* bytes, std::int64_t size) const {
    while (size > 0) {
      const ssize_t got = ::pread(descriptor_, bytes, static_cast<std::size_t>(size), place);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) fail(std::strerror(errno));
      if (got == 0) fail("it ends too early");
      bytes += got;
      place += got;
      size -= got;
    }
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw Error(ErrorKind::file, "cannot read " + name_ + ": " + reason);
  }

  std::string name_;
  int descriptor_;
};

// Reads `rows` rows, from row `first` on, into an array of records.
template <class Record>
void read_rows(const InputFile& file, const Column& column, std::int64_t place, std::int64_t first,
               std::int64_t rows, Record* records) {
  const std::int64_t size = column.array.row_size();
  const std::size_t given = static_cast<std::size_t>(column.given) * size_of(column.array.type);
  Bytes piece;
  in_pieces(rows, size, [&](std::int64_t from, std::int64_t n) {
    piece.resize(static_cast<std::size_t>(n * size));
    file.read_at(place + (first + from) * size, piece.data(), n * size);
    for (std::int64_t k = 0; k < n; ++k)
      std::memcpy(reinterpret_cast<char*>(records + from + k) + column.offset,
                  piece.data() + k * size, given);
  });
}

// Returns the contiguous share of n items that falls to this rank.
RankSpan share_of(const Communicator& comm, std::int64_t n) {
  const std::int64_t each = n / comm.size(), more = n % comm.size(), rank = comm.rank();
  return {each * rank + std::min(rank, more), each + (rank < more), n};
}

template <int Dim>
// A reader of a checkpoint into a placement. All ranks construct it and call read().
class CheckpointReader {
 public:
  CheckpointReader(PlacementImpl<Dim>& placement, const std::string& path)
      : comm_(*placement.ranks()), placement_(placement), path_(path) {}

  void read() {
    collective_try(comm_, [&] {
      if (comm_.rank() == 0) read_layout();
    });
    share_state();
    share(comm_, places_);
    share(comm_, patch_sizes_);
    for_tables(state_, [&](const char*, std::vector<double>& numbers) { share(comm_, numbers); });
    explained([&] { placement_.require_same_as(state_); });
    std::vector<SavedNode<Dim>> nodes;
    Patch<Dim> patch;
    collective_try(comm_, [&] {
      const InputFile file(path_, quoted_checkpoint(path_));
      nodes = read_nodes(file);
      if (state_.spacing_saved) patch = read_patch(file);
    });
    std::uint64_t checksum = 0;
    for (const SavedNode<Dim>& node : nodes) checksum += checksum_of(node);
    const bool same = comm_.allreduce_sum(checksum) + checksum_of_tables(state_) == state_.checksum;
    const bool same_patch =
        !state_.spacing_saved || comm_.allreduce_sum(checksum_of(patch)) == patch_checksum_;
    if (!same || !same_patch) refuse("the checksum of its arrays does not match");
    explained([&] { placement_.restore(state_, std::move(nodes), std::move(patch)); });
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw Error(ErrorKind::file, quoted_checkpoint(path_) + " is damaged: " + why);
  }

  // Runs `work` and adds the name of the file to its errors.
  template <class Work>
  void explained(const Work& work) const {
    const auto text = [this](const Error& error) {
      return quoted_checkpoint(path_) + ": " + error.message();
    };
    try {
      work();
    } catch (const AgreedError& error) {
      throw AgreedError(error.kind(), text(error), error.reason());
    } catch (const Error& error) {
      throw Error(error.kind(), text(error), error.reason());
    }
  }

  // Reads and checks everything except the rows, by HDF5. Called on rank 0 only.
  void read_layout() {
    hdf5::require_hdf5();
    hdf5::require_signature(path_, quoted_checkpoint(path_));
    require_seal(path_, quoted_checkpoint(path_));
    const hdf5::ExistingFile file(path_, quoted_checkpoint(path_));
    if (!file.has(kOwn))
      throw Error(ErrorKind::file, quoted_checkpoint(path_) + " is an HDF5 file, but not of PNPBS");
    std::int64_t format = 0;
    file.get(kOwn, "format", format);
    if (format != kCheckpointFormat)
      throw Error(ErrorKind::file,
                  quoted_checkpoint(path_) + " has format " + std::to_string(format) +
                      ", and this PNPBS reads format " + std::to_string(kCheckpointFormat) +
                      (format > kCheckpointFormat ? ": a newer one reads it" : ""));
    for_fields(state_, [&](const char* field, auto& value) { get(file, field, value); });
    if (state_.dimension != Dim) return;  // require_same_as() reports it
    if (state_.nodes <= 0) refuse("it has no nodes");
    for (const Column& column : node_columns<Dim>(state_.nodes))
      places_.push_back(file.place_of(column.array));
    for_tables(state_, [&](const char* name, std::vector<double>& numbers) {
      const std::string path = table_path(name);
      if (file.has(path)) numbers = read_numbers<double>(file, path, hdf5::Type::real);
    });
    if (state_.spacing_saved) read_patch_layout(file);
  }

  // Reads a whole column of numbers with eight bytes.
  template <class Number>
  std::vector<Number> read_numbers(const hdf5::ExistingFile& file, const std::string& name,
                                   hdf5::Type type) const {
    const std::int64_t n = file.rows_of(name);
    const std::int64_t place = file.place_of({name, type, n});
    std::vector<Number> numbers(static_cast<std::size_t>(n));
    InputFile(path_, quoted_checkpoint(path_))
        .read_at(place, reinterpret_cast<char*>(numbers.data()), 8 * n);
    return numbers;
  }

  void read_patch_layout(const hdf5::ExistingFile& file) {
    if (!file.has(kSpacing)) refuse("it has no spacing");
    get(file, "spacing_checksum", patch_checksum_);
    patch_sizes_ =
        read_numbers<std::int64_t>(file, std::string(kSpacing) + "/parts", hdf5::Type::int64);
    PatchSizes all;
    const auto add = [&](std::int64_t& sum, std::int64_t size) {
      constexpr std::int64_t kMax = std::int64_t{1} << 31;
      if (size < 0 || size > kMax) refuse("a part of its spacing has an impossible size");
      sum += size;
    };
    if (patch_sizes_.size() % 3 != 0) refuse("a part of its spacing has no size");
    for (std::size_t k = 0; k < patch_sizes_.size(); k += 3) {
      add(all.nodes, patch_sizes_[k]);
      add(all.simplices, patch_sizes_[k + 1]);
      add(all.facets, patch_sizes_[k + 2]);
    }
    const auto find = [&](const Column& column) {
      places_.push_back(column.array.rows > 0 ? file.place_of(column.array) : 0);
    };
    for (const Column& column : patch_node_columns<Dim>(all.nodes)) find(column);
    find(simplex_column<Dim>(all.simplices));
    find(facet_column<Dim>(all.facets));
  }

  template <class Value>
  static void get(const hdf5::ExistingFile& file, const char* field, Value& value) {
    if constexpr (std::is_same_v<Value, std::uint64_t>) {
      std::int64_t bits = 0;
      file.get(kOwn, field, bits);
      value = static_cast<std::uint64_t>(bits);
    } else {
      file.get(kOwn, field, value);
    }
  }

  // Replaces the state on all ranks by that of rank 0. Collective.
  void share_state() {
    Bytes bytes;
    if (comm_.rank() == 0) {
      for_fields(state_, [&](const char*, const auto& value) {
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string>) {
          pack(bytes, std::int64_t{std::ssize(value)});
          bytes.insert(bytes.end(), value.begin(), value.end());
        } else {
          pack(bytes, value);
        }
      });
      pack(bytes, patch_checksum_);
    }
    comm_.broadcast(bytes, 0);
    std::size_t at = 0;
    const auto take = [&](auto& value) {
      std::memcpy(&value, bytes.data() + at, sizeof value);
      at += sizeof value;
    };
    for_fields(state_, [&](const char*, auto& value) {
      if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string>) {
        std::int64_t size = 0;
        take(size);
        value.assign(bytes.data() + at, static_cast<std::size_t>(size));
        at += static_cast<std::size_t>(size);
      } else {
        take(value);
      }
    });
    take(patch_checksum_);
  }

  std::vector<SavedNode<Dim>> read_nodes(const InputFile& file) const {
    const RankSpan mine = share_of(comm_, state_.nodes);
    SavedNode<Dim> none{};
    none.node.reference_on = -1;
    std::vector<SavedNode<Dim>> nodes(static_cast<std::size_t>(mine.count), none);
    std::size_t next = 0;
    for (const Column& column : node_columns<Dim>(state_.nodes))
      read_rows(file, column, places_[next++], mine.first, mine.count, nodes.data());
    return nodes;
  }

  // Reads the parts of a nodal spacing that fall to this rank and joins them to one.
  Patch<Dim> read_patch(const InputFile& file) const {
    const RankSpan parts = share_of(comm_, std::ssize(patch_sizes_) / 3);
    const auto sizes = [this](std::int64_t part) {
      const auto at = static_cast<std::size_t>(3 * part);
      return PatchSizes{patch_sizes_[at], patch_sizes_[at + 1], patch_sizes_[at + 2]};
    };
    const auto add = [](PatchSizes& sum, const PatchSizes& one) {
      sum.nodes += one.nodes;
      sum.simplices += one.simplices;
      sum.facets += one.facets;
    };
    PatchSizes before, mine;
    for (std::int64_t p = 0; p < parts.first; ++p) add(before, sizes(p));
    for (std::int64_t p = 0; p < parts.count; ++p) add(mine, sizes(parts.first + p));
    Patch<Dim> patch;
    patch.nodes.resize(static_cast<std::size_t>(mine.nodes));
    patch.simplices.resize(static_cast<std::size_t>(mine.simplices));
    patch.border.resize(static_cast<std::size_t>(mine.facets));
    std::size_t next = node_columns<Dim>(0).size();
    for (const Column& column : patch_node_columns<Dim>(0))
      read_rows(file, column, places_[next++], before.nodes, mine.nodes, patch.nodes.data());
    read_rows(file, simplex_column<Dim>(0), places_[next++], before.simplices, mine.simplices,
              patch.simplices.data());
    read_rows(file, facet_column<Dim>(0), places_[next++], before.facets, mine.facets,
              patch.border.data());
    for (const PatchNode<Dim>& node : patch.nodes)
      if (!is_usable(node.x) || !is_usable(node.value))
        refuse("a node of its spacing has coordinates or a value that are not usable");
    // Rows count the nodes of their part, so shift them to the joined nodes.
    PatchSizes done;
    for (std::int64_t p = 0; p < parts.count; ++p) {
      const PatchSizes part = sizes(parts.first + p);
      shift(patch.simplices, done.simplices, part.simplices, done.nodes, part.nodes);
      shift(patch.border, done.facets, part.facets, done.nodes, part.nodes);
      add(done, part);
    }
    return patch;
  }

  template <class Rows>
  void shift(Rows& rows, std::int64_t first, std::int64_t n, std::int64_t by,
             std::int64_t nodes) const {
    for (std::int64_t k = first; k < first + n; ++k)
      for (std::int32_t& node : rows[static_cast<std::size_t>(k)]) {
        if (node < 0 || node >= nodes)
          refuse("a simplex of its spacing has a node that does not exist");
        node += static_cast<std::int32_t>(by);
      }
  }

  const Communicator& comm_;
  PlacementImpl<Dim>& placement_;
  std::string path_;
  SavedState state_;
  std::uint64_t patch_checksum_ = 0;
  std::vector<std::int64_t> places_;       // offsets of the arrays, in the order of reading
  std::vector<std::int64_t> patch_sizes_;  // three sizes for each part
};

template <int Dim>
void read_checkpoint_of(PlacementImpl<Dim>& placement, const std::string& path) {
  CheckpointReader<Dim>(placement, path).read();
}

void require_same_path(const Communicator& comm, const std::string& path) {
  Bytes theirs(path.begin(), path.end());
  comm.broadcast(theirs, 0);
  collective_try(comm, [&] {
    if (path.empty())
      throw Error(ErrorKind::argument, "argument path: the name of a file is empty");
    if (std::string(theirs.begin(), theirs.end()) != path)
      throw Error(ErrorKind::argument, "argument path = \"" + path +
                                           "\" is not that of rank 0: name the same file on all "
                                           "ranks");
  });
}

}  // namespace

void write_checkpoint(Placement& placement, const std::string& path) {
  const Communicator& comm = placement.communicator();
  require_same_path(comm, path);
  // If one rank fails in any step, all ranks throw.
  collective_try(comm, [&] {
    visit_dimension(placement,
                    [&]<int Dim>(PlacementImpl<Dim>& it) { write_checkpoint_of(it, path); });
  });
}

void read_checkpoint(Placement& placement, const std::string& path) {
  const Communicator& comm = placement.communicator();
  require_same_path(comm, path);
  collective_try(comm, [&] {
    visit_dimension(placement,
                    [&]<int Dim>(PlacementImpl<Dim>& it) { read_checkpoint_of(it, path); });
  });
}

}  // namespace pnpbs::io
