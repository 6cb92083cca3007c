#include "apps/obscura/scratch_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "fmt/format.h"

namespace obscura::app {

Status ScratchFile::opened(const std::string& path, int flags) {
  close();
  path_ = path;
  file_ = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  if (file_ >= 0) return {};
  return {StatusCode::kInternal, fmt::format("cannot open {}: {}", path, std::strerror(errno))};
}
Status ScratchFile::create(const std::string& path) {
  return opened(path, O_RDWR | O_CREAT | O_TRUNC);
}
Status ScratchFile::open(const std::string& path) { return opened(path, O_RDWR); }

void ScratchFile::close() {
  if (file_ >= 0) ::close(file_);
  file_ = -1;
}

Status ScratchFile::write(std::int64_t at, const void* bytes, std::int64_t count) {
  const char* from = static_cast<const char*>(bytes);
  while (count > 0) {
    const ssize_t done = pwrite(file_, from, static_cast<std::size_t>(count), at);
    if (done <= 0) {
      return {StatusCode::kInternal,
              fmt::format("cannot write {}: {}", path_, std::strerror(done < 0 ? errno : ENOSPC))};
    }
    from += done;
    at += done;
    count -= done;
  }
  return {};
}

Status ScratchFile::read(std::int64_t at, void* bytes, std::int64_t count) const {
  char* to = static_cast<char*>(bytes);
  while (count > 0) {
    const ssize_t done = pread(file_, to, static_cast<std::size_t>(count), at);
    if (done <= 0) {
      return {StatusCode::kInternal,
              fmt::format("cannot read {}: {}", path_,
                          done < 0 ? std::strerror(errno) : "it has become shorter")};
    }
    to += done;
    at += done;
    count -= done;
  }
  return {};
}

}  // namespace obscura::app
