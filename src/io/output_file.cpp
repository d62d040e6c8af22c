// SPDX-License-Identifier: BSD-3-Clause
#include "io/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>
#include <system_error>

#include "base/error.hpp"
#include "io/abandoned_files.hpp"

namespace pnpbs::io {
namespace {

[[noreturn]] void fail(const std::string& what, int error) {
  throw Error(ErrorKind::file, "cannot write " + what + ": " + std::strerror(error));
}

// Renaming onto a symbolic link would replace the link: find the file it means, there or not yet.
std::string behind_links(const std::string& path) {
  constexpr int kMaxLinks = 40;
  std::error_code error;
  const std::filesystem::path there = std::filesystem::canonical(path, error);
  if (!error) return there.string();
  std::filesystem::path target = path;
  for (int link = 0; link < kMaxLinks && std::filesystem::is_symlink(target, error); ++link)
    target = target.parent_path() / std::filesystem::read_symlink(target, error);
  return std::filesystem::is_symlink(target, error) ? path : target.string();
}

// For what may be the only copy of a file: nobody removes it but who has made it.
std::string name_for_old_beside(const std::string& target) {
  static std::random_device random;
  const std::filesystem::path folder = std::filesystem::path(target).parent_path();
  const std::string name =
      ".pnpbs-old-" + std::to_string(::getpid()) + "-" + std::to_string(random());
  return (folder / name).string();
}

// A file that is replaced keeps its permissions.
void copy_permissions(const std::string& from, int to) {
  struct stat status;
  if (::stat(from.c_str(), &status) == 0) ::fchmod(to, status.st_mode & 07777);
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path), target_(behind_links(path)) {}

std::string OutputFile::quoted() const {
  return is_standard_output() ? "standard output" : "'" + path_ + "'";
}

bool OutputFile::written_aside() const {
  std::error_code error;
  const auto type = std::filesystem::status(target_, error).type();
  return !is_standard_output() && (type == std::filesystem::file_type::regular ||
                                   type == std::filesystem::file_type::not_found);
}

void OutputFile::check() const {
  if (is_standard_output()) return;
  std::error_code error;
  if (std::filesystem::is_directory(target_, error)) fail(quoted(), EISDIR);
  if (std::filesystem::exists(target_, error) && ::access(target_.c_str(), W_OK) != 0) {
    fail(quoted(), errno);
  }
  if (!written_aside()) return;
  const std::filesystem::path target(target_);
  if (target.filename().empty() || target.filename().string().size() > NAME_MAX) {
    fail(quoted(), target.filename().empty() ? EISDIR : ENAMETOOLONG);
  }
  std::unique_ptr<Temporary> trial;
  ::close(open_aside(trial));
}

int OutputFile::open_aside(std::unique_ptr<Temporary>& temporary) const {
  // Listed before it is created, so that no signal finds it unlisted.
  temporary = std::make_unique<Temporary>(unfinished_name_beside(target_));
  const int descriptor = ::open(temporary->path(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    temporary->keep();  // it is not ours
    fail(quoted(), errno);
  }
  if (temporary->removed()) {  // before it was there
    ::close(descriptor);
    ::unlink(temporary->path());
    fail(quoted(), EINTR);
  }
  copy_permissions(target_, descriptor);
  return descriptor;
}

int OutputFile::open() {
  if (written_aside()) {
    remove_abandoned_beside(target_);
    return open_aside(temporary_);
  }
  const int descriptor =
      is_standard_output() ? ::dup(STDOUT_FILENO) : ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) fail(quoted(), errno);
  return descriptor;
}

void OutputFile::close(int descriptor) const {
  if (::close(descriptor) != 0) fail(quoted(), errno);
}

void OutputFile::write(const std::function<void(Sink&)>& writer,
                       const std::function<void()>& before_write) {
  const int descriptor = open();
  try {
    Sink sink(to_descriptor(descriptor, quoted(), before_write));
    writer(sink);
    sink.flush();
  } catch (...) {
    ::close(descriptor);
    temporary_.reset();
    throw;
  }
  close(descriptor);
}

// ------------------------------------------------------------------ giving names ---------------

void OutputFile::seal() {
  if (temporary_ && !temporary_->seal()) fail(quoted(), EINTR);
}

// By a second link, so that its name never stands for nothing; where the file system has no links,
// by another name.
void OutputFile::set_old_aside() {
  const std::string aside = name_for_old_beside(target_);
  old_is_linked_ = ::link(target_.c_str(), aside.c_str()) == 0;
  if (!old_is_linked_ && std::rename(target_.c_str(), aside.c_str()) != 0) {
    if (errno != ENOENT) fail(quoted(), errno);
    return;  // there was none
  }
  old_ = aside;
}

void OutputFile::publish() {
  if (!temporary_) return;
  set_old_aside();
  if (std::rename(temporary_->path(), target_.c_str()) != 0) fail(quoted(), errno);
  published_ = true;
  temporary_->keep();
}

void OutputFile::withdraw() noexcept {
  if (!old_.empty() && old_is_linked_ && !published_)
    ::unlink(old_.c_str());
  else if (!old_.empty())
    std::rename(old_.c_str(), target_.c_str());
  else if (published_)
    ::unlink(target_.c_str());
  old_.clear();
  published_ = false;
  temporary_.reset();
}

void OutputFile::settle() noexcept {
  if (!old_.empty()) ::unlink(old_.c_str());
  old_.clear();
  published_ = false;
  temporary_.reset();
}

void publish_together(const std::vector<OutputFile*>& files, const Together& together) {
  try {
    together([&] {
      for (OutputFile* file : files) file->seal();
    });
    together([&] {
      for (OutputFile* file : files) file->publish();
    });
  } catch (...) {
    for (OutputFile* file : files) file->withdraw();
    throw;
  }
  for (OutputFile* file : files) file->settle();
}

}  // namespace pnpbs::io
