#include "apps/mpi/shared_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "fmt/format.h"

namespace obscura::mpi {
namespace {

std::string beside(const std::string& path) {
  const std::filesystem::path p(path);
  return (p.parent_path() / ("." + p.filename().string() + ".obscura-mpi")).string();
}

std::string text_of(int error) {
  char text[MPI_MAX_ERROR_STRING] = "";
  int length = 0;
  MPI_Error_string(error, text, &length);
  return text;
}

}  // namespace

SharedFile::SharedFile(const Ranks& ranks, const std::string& path)
    : ranks_(ranks), path_(path), unfinished_(beside(path)), registered_(unfinished_) {}

SharedFile::~SharedFile() {
  if (file_ == MPI_FILE_NULL) return;
  MPI_File_close(&file_);
  if (ranks_.first()) unlink(unfinished_.c_str());
}

Status SharedFile::open() {
  Status made;
  if (ranks_.first()) {
    // By plain means first: their errors say more than MPI's.
    const int file = ::open(unfinished_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0 || ::close(file) != 0) {
      made = {StatusCode::kInternal,
              fmt::format("cannot write {}: {}", path_, std::strerror(errno))};
    }
  }
  if (Status s = ranks_.agree(made, false); !s.ok()) return s;
  const int error =
      MPI_File_open(MPI_COMM_WORLD, unfinished_.c_str(), MPI_MODE_WRONLY, MPI_INFO_NULL, &file_);
  if (error == MPI_SUCCESS) return {};
  if (ranks_.first()) unlink(unfinished_.c_str());
  return {StatusCode::kInternal, fmt::format("cannot write {} by all ranks: {}; its folder must be "
                                             "shared by them",
                                             path_, text_of(error))};
}

Status SharedFile::write(std::int64_t offset, const void* bytes, std::int64_t count) {
  // MPI counts in int.
  constexpr std::int64_t kMost = 1 << 28;
  const char* from = static_cast<const char*>(bytes);
  while (count > 0) {
    const int part = static_cast<int>(std::min(count, kMost));
    MPI_Status status;
    int written = 0;
    int error = MPI_File_write_at(file_, offset, from, part, MPI_BYTE, &status);
    if (error == MPI_SUCCESS) error = MPI_Get_count(&status, MPI_BYTE, &written);
    if (error != MPI_SUCCESS || written != part) {
      const std::string why =
          error != MPI_SUCCESS ? text_of(error) : "the disk is full or the file's size limited";
      return {StatusCode::kInternal, fmt::format("cannot write {}: {}", path_, why)};
    }
    offset += part;
    from += part;
    count -= part;
  }
  return {};
}

Status SharedFile::finish(const Status& written, std::int64_t bytes) {
  Status mine = written;
  if (mine.ok() && MPI_File_sync(file_) != MPI_SUCCESS) {
    mine = {StatusCode::kInternal, fmt::format("cannot write {} to its disk", path_)};
  }
  const int closed = MPI_File_close(&file_);
  if (mine.ok() && closed != MPI_SUCCESS) {
    mine = {StatusCode::kInternal, fmt::format("cannot close {}: {}", path_, text_of(closed))};
  }
  Status s = ranks_.agree(mine);
  if (s.ok() && ranks_.first()) {
    std::error_code error;
    const auto length = static_cast<std::int64_t>(std::filesystem::file_size(unfinished_, error));
    if (error || length != bytes) {
      s = {StatusCode::kInternal,
           fmt::format("{} has {} bytes after writing, not {}; its folder must be shared by all "
                       "ranks",
                       path_, error ? 0 : length, bytes)};
    } else if (std::rename(unfinished_.c_str(), path_.c_str()) != 0) {
      s = {StatusCode::kInternal, fmt::format("cannot write {}: {}", path_, std::strerror(errno))};
    }
  }
  s = ranks_.agree(s, false);
  if (!s.ok() && ranks_.first()) unlink(unfinished_.c_str());
  return s;
}

}  // namespace obscura::mpi
