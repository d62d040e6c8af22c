// SPDX-License-Identifier: BSD-3-Clause
#include "comm/shared_writer.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.hpp"

namespace pnpbs {

namespace {

class PlainFile : public SharedWriter {
 public:
  PlainFile(const std::string& path, std::string name)
      : name_(std::move(name)), descriptor_(::open(path.c_str(), O_WRONLY | O_CLOEXEC)) {
    if (descriptor_ < 0) fail();
  }
  PlainFile(const PlainFile&) = delete;
  PlainFile& operator=(const PlainFile&) = delete;
  ~PlainFile() override {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  void write_at(std::int64_t place, std::span<const char> bytes) override {
    while (!bytes.empty()) {
      const ssize_t wrote = ::pwrite(descriptor_, bytes.data(), bytes.size(), place);
      if (wrote < 0 && errno == EINTR) continue;
      if (wrote < 0) fail();
      bytes = bytes.subspan(static_cast<std::size_t>(wrote));
      place += wrote;
    }
  }

  void close() override {
    const int descriptor = descriptor_;
    descriptor_ = -1;
    if (::close(descriptor) != 0) fail();
  }

 private:
  [[noreturn]] void fail() const {
    throw Error(ErrorKind::file, "cannot write " + name_ + ": " + std::strerror(errno));
  }

  std::string name_;
  int descriptor_;
};

}  // namespace

std::unique_ptr<SharedWriter> open_alone(const std::string& path, const std::string& name) {
  return std::make_unique<PlainFile>(path, name);
}

}  // namespace pnpbs
