// SPDX-License-Identifier: BSD-3-Clause
// A file that all ranks write together, one part behind the other, none of them holding it all.
// It appears under its name only when it is complete.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "comm/communicator.hpp"
#include "io/output_file.hpp"

namespace pnpbs::io {

// All members are collective; what fails on one rank is thrown on all of them, and then nothing is
// left of the file.
class SharedFile {
 public:
  // path "-" is standard output of rank 0. before_write: see to_descriptor.
  SharedFile(std::shared_ptr<const Communicator> comm, const std::string& path,
             std::function<void()> before_write);
  ~SharedFile();
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;

  // Has rank 0 make the file, which is empty, as it is to be before anything is appended, and
  // return what the others shall know of it. Not for streams and devices.
  std::vector<std::int64_t> make(
      const std::function<std::vector<std::int64_t>(const OutputFile&)>& work);
  // What is appended next goes here, in a file that has been made.
  void go_to(std::int64_t place);

  // Every rank's bytes, those of rank 0 first. write fills its sink; it may be called twice, to
  // measure and to write, and must not communicate.
  void append(const std::function<void(Sink&)>& write);
  // This text once.
  void append_text(std::string_view text);
  void close();

  // The file itself, on the rank that has made it and gives it its name; nullptr on the others.
  // Local.
  OutputFile* own() { return is_first() ? &output_ : nullptr; }

  const std::string& path() const { return output_.path(); }
  const Communicator& ranks() const { return *comm_; }
  bool is_first() const { return comm_->rank() == 0; }

 private:
  static constexpr std::size_t kPartSize = std::size_t{1} << 20;  // bytes written or sent at a time

  void create();
  void open();
  void append_at_places(const std::function<void(Sink&)>& write);
  void write_at_place(std::span<const char> bytes);
  void append_in_turn(const std::function<void(Sink&)>& write);
  bool pass_to_first(std::span<const char> bytes, Sink& stream);

  std::shared_ptr<const Communicator> comm_;
  std::function<void()> before_write_;
  OutputFile output_;  // rank 0's
  // A regular file is written by all ranks at once, each at its place; what is none, such as a
  // pipe, by rank 0, to which the others send their bytes in turn.
  std::unique_ptr<SharedWriter> file_;
  bool opened_ = false;
  int stream_ = -1;         // rank 0's
  std::int64_t end_ = 0;    // of what all ranks have appended
  std::int64_t place_ = 0;  // of this rank's next byte
  Sink places_{[this](std::span<const char> bytes) { write_at_place(bytes); }, kPartSize};
};

}  // namespace pnpbs::io
