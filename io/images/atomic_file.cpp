#include "io/images/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>

#include "fmt/format.h"

namespace obscura::tools {
namespace {

Status cannot(const char* verb, const std::string& path, const std::string& reason) {
  return {StatusCode::kInternal, fmt::format("cannot {} {}: {}", verb, path, reason)};
}

// Permissions of the file to be replaced, or those that a new file would get.
mode_t wanted_mode(const std::string& path) {
  struct stat info = {};
  if (stat(path.c_str(), &info) == 0) return info.st_mode & 07777;
  const mode_t mask = umask(0);
  umask(mask);
  return 0666 & ~mask;
}

// Runs `write` on the file `temporary`, which messages shall call `path`.
Status attempt(const std::string& path, const std::string& temporary,
               const std::function<Status(const std::string&)>& write) {
  Status status;
  try {
    status = write(temporary);
  } catch (const std::bad_alloc&) {
    return {StatusCode::kOutOfMemory, fmt::format("cannot write {}: not enough memory", path)};
  } catch (const std::exception& e) {
    status = cannot("write", path, e.what());
  }
  std::string message = status.message();
  for (auto at = message.find(temporary); temporary != path && at != std::string::npos;
       at = message.find(temporary)) {
    message.replace(at, temporary.size(), path);
  }
  return {status.code(), std::move(message)};
}

}  // namespace

Status write_atomically(const std::string& path,
                        const std::function<Status(const std::string& temporary)>& write) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::is_directory(path, error)) return cannot("write", path, "it is a folder");
  const IgnoreFileSizeSignal guard;
  // Pipes and devices have no content to lose and must stay what they are.
  if (fs::exists(path, error) && !fs::is_regular_file(path, error))
    return attempt(path, path, write);
  // A link stays a link.
  const bool link = fs::is_symlink(path, error) && fs::exists(path, error);
  const std::string target = link ? fs::canonical(path, error).string() : path;
  std::string temporary = target + ".XXXXXX";
  const int file = mkstemp(temporary.data());
  if (file < 0) return cannot("write", path, std::strerror(errno));
  Status status = attempt(path, temporary, write);
  if (status.ok() && fchmod(file, wanted_mode(target)) != 0 && errno != EPERM) {
    status = cannot("write", path, std::strerror(errno));
  }
  if (status.ok() && fsync(file) != 0 && errno != EINVAL) {
    status = cannot("write", path, std::strerror(errno));
  }
  if (close(file) != 0 && status.ok()) status = cannot("write", path, std::strerror(errno));
  if (status.ok() && std::rename(temporary.c_str(), target.c_str()) != 0) {
    status = cannot("write", path, std::strerror(errno));
  }
  if (!status.ok()) unlink(temporary.c_str());
  return status;
}

Status write_text(const std::string& path, std::string_view bytes) {
  return write_atomically(path, [&](const std::string& temporary) -> Status {
    std::FILE* file = std::fopen(temporary.c_str(), "wb");
    if (!file) return cannot("write", path, std::strerror(errno));
    errno = 0;
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    const int write_error = errno;
    const bool closed = std::fclose(file) == 0;
    if (written && closed) return {};
    return cannot("write", path, std::strerror(written ? errno : write_error));
  });
}

Status check_readable(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    return invalid_input(fmt::format("cannot read {}: it is a folder", path));
  }
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (!file) return invalid_input(fmt::format("cannot read {}: {}", path, std::strerror(errno)));
  const bool empty = std::fgetc(file) == EOF;
  std::fclose(file);
  if (empty) return invalid_input(fmt::format("cannot read {}: the file is empty", path));
  return {};
}

Status read_bytes(const std::string& path, std::string* bytes, std::size_t limit) {
  if (Status s = check_readable(path); !s.ok()) return s;
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (!file) return invalid_input(fmt::format("cannot read {}: {}", path, std::strerror(errno)));
  bytes->clear();
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  std::size_t got = kBlock;
  while (got == kBlock && bytes->size() <= limit) {
    const std::size_t old = bytes->size();
    bytes->resize(old + kBlock);
    got = std::fread(bytes->data() + old, 1, kBlock, file);
    bytes->resize(old + got);
  }
  const bool failed = std::ferror(file) != 0;
  std::fclose(file);
  if (failed) return invalid_input(fmt::format("cannot read {}: {}", path, std::strerror(errno)));
  if (bytes->size() > limit) {
    return invalid_input(fmt::format("cannot read {}: it is larger than {} bytes", path, limit));
  }
  return {};
}

}  // namespace obscura::tools
