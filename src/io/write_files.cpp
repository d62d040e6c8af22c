// SPDX-License-Identifier: BSD-3-Clause
#include "io/write_files.hpp"

#include <filesystem>
#include <memory>
#include <optional>

#include "core/error.hpp"
#include "io/node_blocks.hpp"

namespace pnpbs::io {

namespace {

[[noreturn]] void refuse(const std::string& what) { throw Error(PNPBS_ERROR_ARGUMENT, what); }

const Format& format_of(const std::string& path, const std::string& name) {
  const Format* format = name.empty() ? format_by_extension(path) : format_by_name(name);
  if (format) return *format;
  if (name.empty())
    refuse("the name of '" + path + "' tells no format; it should end in one of " +
           list_of_formats());
  refuse("unknown format \"" + name + "\"; known are " + list_of_formats());
}

std::string with_extension(const std::string& path, const char* extension) {
  return std::filesystem::path(path).replace_extension(extension).string();
}

// The files of one call. Their contents are collected once.
class Writing {
 public:
  Writing(Placement& placement, std::size_t files) : placement_(placement), expected_(files) {}

  void add(const FileWish& wish) {
    if (wish.format->write) {
      add_file(wish);
    } else {
      add_piece(wish);
      add_list_of_pieces(wish);
    }
    ++done_;
  }

  // Pieces before the file that names them.
  void publish() {
    for (const auto& file : files_) file->publish();
  }

 private:
  const std::shared_ptr<const Communicator>& comm() const { return placement_.ranks(); }

  SharedFile& open(const std::shared_ptr<const Communicator>& ranks, const std::string& path) {
    return *files_.emplace_back(
        std::make_unique<SharedFile>(ranks, path, [this] { give_up_if_asked(); }));
  }

  void add_file(const FileWish& wish) {
    std::optional<NodeBlock>& block = wish.elements ? with_elements_ : nodes_only_;
    if (!block) block = block_by_id(placement_, wish.elements);
    SharedFile& file = open(comm(), wish.path);
    wish.format->write(*block, file);
    file.close();
  }

  // Each rank alone; what fails on one is told to all.
  void add_piece(const FileWish& wish) {
    const NodeBlock block = own_piece(placement_, wish.elements);
    agreed(*comm(), [&] {
      SharedFile& file = open(serial_communicator(), piece_path(wish.path, comm()->rank()));
      write_vtu(block, file);
      file.close();
    });
  }

  void add_list_of_pieces(const FileWish& wish) {
    std::vector<std::string> pieces;
    for (int rank = 0; rank < comm()->size(); ++rank) pieces.push_back(piece_path(wish.path, rank));
    SharedFile& file = open(comm(), wish.path);
    write_pvtu(pieces, wish.elements, file);
    file.close();
  }

  void give_up_if_asked() const {
    const double fraction = static_cast<double>(done_) / static_cast<double>(expected_);
    if (placement_.asks_to_stop(fraction, nodes_))
      throw Error(PNPBS_STOPPED, "stopped by the monitor; no file was written");
  }

  Placement& placement_;
  const std::int64_t nodes_ = placement_.global_count();
  std::size_t expected_, done_ = 0;
  std::optional<NodeBlock> with_elements_, nodes_only_;
  std::vector<std::unique_ptr<SharedFile>> files_;
};

}  // namespace

void add_wish(const std::string& path, const std::string& format_name, bool elements,
              std::vector<FileWish>& wishes) {
  if (path.empty()) refuse("the name of a file is empty");
  const Format& format = format_of(path, format_name);
  if (!format.write && path == "-")
    refuse("a file in pieces cannot go to standard output; take vtu instead of pvtu");
  if (elements && format.elements == Elements::never)
    refuse(std::string("a .") + format.name + " file has no place for elements: '" + path + "'");
  const bool beside = elements && format.elements == Elements::beside;
  if (beside && path == "-")
    refuse("elements would go to a second file beside standard output: ask for ele there");
  const bool holds_elements =
      format.elements == Elements::always || (elements && format.elements == Elements::on_request);
  wishes.push_back({path, &format, holds_elements});
  if (beside) wishes.push_back({with_extension(path, "ele"), format_by_name("ele"), true});
}

std::string piece_path(const std::string& path, int rank) {
  const std::filesystem::path whole(path);
  return (whole.parent_path() / (whole.stem().string() + "_" + std::to_string(rank) + ".vtu"))
      .string();
}

void write_files(Placement& placement, const std::vector<FileWish>& wishes) {
  Writing writing(placement, wishes.size());
  for (const FileWish& wish : wishes) writing.add(wish);
  writing.publish();
}

}  // namespace pnpbs::io
