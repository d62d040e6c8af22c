// SPDX-License-Identifier: BSD-3-Clause
// Files that all ranks write together, one rank's part after the other, without collecting them on
// one rank. A file appears under its name only when complete.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "comm/communicator.hpp"
#include "io/output_file.hpp"

namespace pnpbs::io {

// A shared output file. All members are collective unless marked; if one rank throws, all ranks
// throw, and the file is removed.
class SharedFile {
 public:
  // Path "-" is standard output of rank 0. `before_write`: see to_descriptor().
  SharedFile(std::shared_ptr<const Communicator> comm, const std::string& path,
             std::function<void()> before_write);
  ~SharedFile();
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;

  // Calls work(file) on rank 0, which writes the initial contents of the file, and returns its
  // result on all ranks. Throws for streams and devices.
  std::vector<std::int64_t> make(
      const std::function<std::vector<std::int64_t>(const OutputFile&)>& work);
  // Sets the offset of the next append() in a file whose contents make() has written. [bytes]
  void go_to(std::int64_t place);

  // Appends the bytes of all ranks in the order of the ranks. write(sink) may be called twice, to
  // measure and to write, and must not communicate.
  void append(const std::function<void(Sink&)>& write);
  // Appends the text once.
  void append_text(std::string_view text);
  void close();

  // Returns the file on rank 0, which publishes it, and nullptr on other ranks. Local.
  OutputFile* own() { return is_first() ? &output_ : nullptr; }

  const std::string& path() const { return output_.path(); }
  const Communicator& ranks() const { return *comm_; }
  bool is_first() const { return comm_->rank() == 0; }

 private:
  // Size of a write or message. [bytes]
  static constexpr std::size_t kPartSize = std::size_t{1} << 20;

  void create();
  void open();
  void append_at_places(const std::function<void(Sink&)>& write);
  void write_at_place(std::span<const char> bytes);
  void append_in_turn(const std::function<void(Sink&)>& write);
  bool pass_to_first(std::span<const char> bytes, Sink& stream);

  std::shared_ptr<const Communicator> comm_;
  std::function<void()> before_write_;
  OutputFile output_;  // used on rank 0
  // Set for a regular file, which all ranks write at their offsets. Other files, such as pipes, are
  // written by rank 0, and the other ranks send their bytes to it.
  std::unique_ptr<SharedWriter> file_;
  bool opened_ = false;
  int stream_ = -1;         // file descriptor on rank 0, -1: none
  std::int64_t end_ = 0;    // end of the bytes of all ranks
  std::int64_t place_ = 0;  // offset of this rank's next byte
  Sink places_{[this](std::span<const char> bytes) { write_at_place(bytes); }, kPartSize};
};

}  // namespace pnpbs::io
