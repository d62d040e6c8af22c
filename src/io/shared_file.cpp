// SPDX-License-Identifier: BSD-3-Clause
#include "io/shared_file.hpp"

#include <unistd.h>

#include "base/error.hpp"
#include "comm/rank_span.hpp"
#include "comm/records.hpp"

namespace pnpbs::io {

SharedFile::SharedFile(std::shared_ptr<const Communicator> comm, const std::string& path,
                       std::function<void()> before_write)
    : comm_(std::move(comm)), before_write_(std::move(before_write)), output_(path) {
  create();
}

SharedFile::~SharedFile() {
  if (stream_ >= 0) ::close(stream_);
}

void SharedFile::create() {
  collective_try(*comm_, [&] {
    if (before_write_) before_write_();
    if (!is_first()) return;
    output_.check();
    const int descriptor = output_.open();
    if (output_.written_aside())
      output_.close(descriptor);
    else
      stream_ = descriptor;
  });
}

// Opens the file on all ranks, if it is not a stream. Rank 0 sends its name. Collective.
void SharedFile::open() {
  opened_ = true;
  Bytes aside;
  if (is_first() && stream_ < 0) {
    const std::string name = output_.name_aside();
    aside.assign(name.begin(), name.end());
  }
  comm_->broadcast(aside, 0);
  if (!aside.empty())
    file_ = comm_->open_file(std::string(aside.begin(), aside.end()), output_.quoted());
}

std::vector<std::int64_t> SharedFile::make(
    const std::function<std::vector<std::int64_t>(const OutputFile&)>& work) {
  Bytes bytes;
  collective_try(*comm_, [&] {
    if (before_write_) before_write_();
    if (!is_first()) return;
    if (stream_ >= 0)
      throw Error(ErrorKind::argument, "cannot write " + output_.quoted() +
                                           ": it must be a regular file, no stream and no "
                                           "device");
    for (const std::int64_t number : work(output_)) pack(bytes, number);
  });
  comm_->broadcast(bytes, 0);
  std::vector<std::int64_t> numbers;
  for_records<std::int64_t>(bytes, [&](std::int64_t number) { numbers.push_back(number); });
  return numbers;
}

void SharedFile::go_to(std::int64_t place) {
  collective_try(*comm_, [&] { places_.flush(); });
  end_ = place_ = place;
}

void SharedFile::append(const std::function<void(Sink&)>& write) {
  if (!opened_) open();
  if (file_)
    append_at_places(write);
  else
    append_in_turn(write);
}

void SharedFile::append_text(std::string_view text) {
  append([&](Sink& sink) {
    if (is_first()) sink.text(text);
  });
}

// Appends to a regular file. Several ranks measure their bytes first to find their offsets. A
// single rank writes at once.
void SharedFile::append_at_places(const std::function<void(Sink&)>& write) {
  if (comm_->size() == 1) return write(places_);
  std::int64_t size = 0;
  collective_try(*comm_, [&] {
    Sink counter([&](std::span<const char> bytes) { size += std::ssize(bytes); });
    write(counter);
    counter.flush();
  });
  const RankSpan span = span_of(*comm_, static_cast<std::size_t>(size));
  place_ = end_ + span.first;
  end_ += span.total;
  collective_try(*comm_, [&] {
    write(places_);
    places_.flush();
  });
}

void SharedFile::write_at_place(std::span<const char> bytes) {
  if (before_write_) before_write_();
  file_->write_at(place_, bytes);
  place_ += std::ssize(bytes);
}

// Appends to a stream. The ranks send their bytes to rank 0 in parts, one rank after the other. All
// ranks take part in each step, so that all of them notice a failure.
void SharedFile::append_in_turn(const std::function<void(Sink&)>& write) {
  collective_try(*comm_, [&] {
    Sink stream(to_descriptor(stream_, output_.quoted(), before_write_));
    if (is_first()) {
      write(stream);
      stream.flush();
    }
    for (int rank = 1; rank < comm_->size(); ++rank) {
      if (rank == comm_->rank()) {
        Sink sink([&](std::span<const char> bytes) { pass_to_first(bytes, stream); }, kPartSize);
        write(sink);
        sink.flush();
        pass_to_first({}, stream);
      } else {
        while (pass_to_first({}, stream)) {
        }
      }
    }
  });
}

// Sends a part of one rank to the stream of rank 0. Returns false if no rank has bytes. Collective.
bool SharedFile::pass_to_first(std::span<const char> bytes, Sink& stream) {
  if (comm_->allreduce_sum(static_cast<std::uint64_t>(bytes.size())) == 0) return false;
  std::vector<Message> part;
  if (!bytes.empty()) part.push_back({0, Bytes(bytes.begin(), bytes.end())});
  for (const Message& message : comm_->sparse_all_to_all(part)) {
    stream.bytes(message.bytes.data(), message.bytes.size());
    stream.flush();
  }
  return true;
}

void SharedFile::close() {
  collective_try(*comm_, [&] {
    if (file_) {
      places_.flush();
      file_->close();
    }
    if (stream_ < 0) return;
    const int descriptor = stream_;
    stream_ = -1;
    output_.close(descriptor);
  });
}

}  // namespace pnpbs::io
