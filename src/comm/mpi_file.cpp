// SPDX-License-Identifier: BSD-3-Clause
#include "base/build_config.hpp"

#if PNPBS_HAVE_MPI

#include <mpi.h>

#include "base/error.hpp"
#include "comm/mpi_file.hpp"

namespace pnpbs {

namespace {

class MpiFile : public SharedWriter {
 public:
  // Sets the error handler of the file, because the host program may have changed the default. The
  // opening itself uses the handler of MPI_FILE_NULL.
  MpiFile(const std::string& path, std::string name) : name_(std::move(name)) {
    check(MPI_File_open(MPI_COMM_SELF, path.c_str(), MPI_MODE_WRONLY, MPI_INFO_NULL, &file_));
    check(MPI_File_set_errhandler(file_, MPI_ERRORS_RETURN));
  }
  MpiFile(const MpiFile&) = delete;
  MpiFile& operator=(const MpiFile&) = delete;
  ~MpiFile() override {
    if (file_ != MPI_FILE_NULL) MPI_File_close(&file_);
  }

  void write_at(std::int64_t place, std::span<const char> bytes) override {
    const int size = static_cast<int>(bytes.size());  // the buffer of a sink, never near 2^31
    MPI_Status status;
    check(MPI_File_write_at(file_, place, bytes.data(), size, MPI_BYTE, &status));
    int wrote = 0;
    check(MPI_Get_count(&status, MPI_BYTE, &wrote));
    if (wrote != size)  // some file system drivers report a full disk this way
      throw Error(ErrorKind::file, "cannot write " + name_ + ": only " + std::to_string(wrote) +
                                       " of " + std::to_string(size) +
                                       " bytes were written; is the disk full?");
  }

  void close() override {
    const int code = MPI_File_close(&file_);
    file_ = MPI_FILE_NULL;
    check(code);
  }

 private:
  void check(int code) const {
    if (code == MPI_SUCCESS) return;
    char text[MPI_MAX_ERROR_STRING] = "";
    int length = 0;
    MPI_Error_string(code, text, &length);
    throw Error(ErrorKind::file, "cannot write " + name_ + ": " + text);
  }

  std::string name_;
  MPI_File file_ = MPI_FILE_NULL;
};

}  // namespace

std::unique_ptr<SharedWriter> open_by_mpi(const std::string& path, const std::string& name) {
  return std::make_unique<MpiFile>(path, name);
}

}  // namespace pnpbs

#endif
