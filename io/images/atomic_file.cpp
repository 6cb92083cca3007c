#include "io/images/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>

#include "fmt/format.h"

namespace obscura::tools {
// Names of temporary files that stand in folders now, for remove_temporaries(). A slot's owner sets
// its name before it says so.
struct TemporarySlot {
  std::atomic<int> state{0};  // 0: free, 1: being changed, 2: there is a file
  char name[4200];
};
namespace {
TemporarySlot g_slots[64];
}

TemporaryName::TemporaryName(const std::string& name) {
  if (name.size() >= sizeof(TemporarySlot::name)) return;
  for (TemporarySlot& slot : g_slots) {
    int free = 0;
    if (!slot.state.compare_exchange_strong(free, 1)) continue;
    std::memcpy(slot.name, name.c_str(), name.size() + 1);
    slot.state = 2;
    slot_ = &slot;
    return;
  }
}
TemporaryName::~TemporaryName() {
  if (slot_) slot_->state = 0;
}

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

// The file that is written before it takes its name. Where the system has files without a name, it
// gets one only when it is whole, so that nothing is left even where the process is killed.
class Temporary {
 public:
  explicit Temporary(const std::string& target)
      : folder_(std::filesystem::path(target).parent_path().string()) {
    if (folder_.empty()) folder_ = ".";
#ifdef O_TMPFILE
    file_ = open(folder_.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (file_ >= 0) {
      path_ = fmt::format("/proc/self/fd/{}", file_);
      if (access(path_.c_str(), W_OK) == 0) return;
      close(file_);
    }
#endif
    path_ = folder_ + "/.obscura-XXXXXX";
    file_ = mkstemp(path_.data());
    if (file_ < 0) return;
    named_ = true;
    registered_.emplace(path_);
  }
  ~Temporary() {
    if (file_ >= 0) close(file_);
    if (named_) unlink(path_.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  int file() const { return file_; }
  const std::string& path() const { return path_; }  // opens the file

  // Gives the file its name, in place of an older file. 0 or errno.
  int take_name(const std::string& target) {
    if (fsync(file_) != 0 && errno != EINVAL) return errno;
    if (named_) {
      const int closed = close(file_);
      file_ = -1;
      if (closed != 0) return errno;
    } else {
      // A name that is free is taken in one step.
      const std::string open_file = path_;
      if (linkat(AT_FDCWD, open_file.c_str(), AT_FDCWD, target.c_str(), AT_SYMLINK_FOLLOW) == 0) {
        return 0;
      }
      // A link cannot replace a file: it gets a name of its own first, until the next line.
      if (const int error = link_beside(); error != 0) return error;
    }
    if (std::rename(path_.c_str(), target.c_str()) != 0) return errno;
    named_ = false;
    return 0;
  }

 private:
  int link_beside() {
    const std::string open_file = path_;
    for (int i = 0; i < 1000; ++i) {
      path_ = fmt::format("{}/.obscura-{}-{}", folder_, getpid(), g_count++);
      registered_.emplace(path_);
      if (linkat(AT_FDCWD, open_file.c_str(), AT_FDCWD, path_.c_str(), AT_SYMLINK_FOLLOW) == 0) {
        named_ = true;
        return 0;
      }
      registered_.reset();
      if (errno != EEXIST) break;
    }
    return errno;
  }

  static inline std::atomic<unsigned> g_count{0};
  std::string folder_, path_;
  int file_ = -1;
  bool named_ = false;
  std::optional<TemporaryName> registered_;
};

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
  Temporary temporary(target);
  if (temporary.file() < 0) return cannot("write", path, std::strerror(errno));
  Status status = attempt(path, temporary.path(), write);
  if (!status.ok()) return status;
  if (fchmod(temporary.file(), wanted_mode(target)) != 0 && errno != EPERM) {
    return cannot("write", path, std::strerror(errno));
  }
  const int error_number = temporary.take_name(target);
  return error_number == 0 ? Status() : cannot("write", path, std::strerror(error_number));
}

void remove_temporaries() {
  for (const TemporarySlot& slot : g_slots) {
    if (slot.state == 2) unlink(slot.name);
  }
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

namespace {

// What can be read as a file: no folder and no device, which may never end.
Status check_kind(const std::string& path, bool pipes) {
  struct stat info = {};
  const char* what = nullptr;
  if (stat(path.c_str(), &info) != 0) what = std::strerror(errno);
  if (!what && S_ISDIR(info.st_mode)) what = "it is a folder";
  if (!what && S_ISFIFO(info.st_mode) && !pipes) {
    what = "it is a pipe, and this kind is not read in order; write it to a file first";
  }
  if (!what && !S_ISREG(info.st_mode) && !S_ISFIFO(info.st_mode)) what = "it is a device, no file";
  if (!what) return {};
  return invalid_input(fmt::format("cannot read {}: {}", path, what));
}

}  // namespace

Status check_readable(const std::string& path) {
  if (Status s = check_kind(path, false); !s.ok()) return s;
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (!file) return invalid_input(fmt::format("cannot read {}: {}", path, std::strerror(errno)));
  const bool empty = std::fgetc(file) == EOF;
  std::fclose(file);
  if (empty) return invalid_input(fmt::format("cannot read {}: the file is empty", path));
  return {};
}

Status read_bytes(const std::string& path, std::string* bytes, std::size_t limit) {
  if (Status s = check_kind(path, true); !s.ok()) return s;
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
  if (bytes->empty()) {
    return invalid_input(fmt::format("cannot read {}: the file is empty", path));
  }
  if (bytes->size() > limit) {
    return invalid_input(fmt::format("cannot read {}: it is larger than {} bytes", path, limit));
  }
  return {};
}

}  // namespace obscura::tools
