#ifndef OBSCURA_IO_IMAGES_ATOMIC_FILE_H_
#define OBSCURA_IO_IMAGES_ATOMIC_FILE_H_

#include <csignal>
#include <functional>
#include <string>
#include <string_view>

#include "obscura/status.h"

namespace obscura::tools {

// A write beyond the limit on a file's size shall fail like any other, not end the process.
class IgnoreFileSizeSignal {
 public:
  IgnoreFileSizeSignal() {
    struct sigaction ignore = {};
    ignore.sa_handler = SIG_IGN;
    sigaction(SIGXFSZ, &ignore, &old_);
  }
  ~IgnoreFileSizeSignal() { sigaction(SIGXFSZ, &old_, nullptr); }
  IgnoreFileSizeSignal(const IgnoreFileSizeSignal&) = delete;
  IgnoreFileSizeSignal& operator=(const IgnoreFileSizeSignal&) = delete;

 private:
  struct sigaction old_ = {};
};

struct TemporarySlot;

// A file that stands under a temporary name: remove_temporaries() removes it as long as this lasts.
class TemporaryName {
 public:
  // Before the file is made, so that it cannot be missed.
  explicit TemporaryName(const std::string& name);
  ~TemporaryName();
  TemporaryName(const TemporaryName&) = delete;
  TemporaryName& operator=(const TemporaryName&) = delete;

 private:
  TemporarySlot* slot_ = nullptr;
};

// Writes a file so that it is whole or not there: `write` fills the temporary file that it is
// given, in the same folder, which then takes the name. On failure, a full disk included, the
// temporary file is removed and an older file of that name stays as it was. A link is followed;
// pipes and devices are written in place.
Status write_atomically(const std::string& path,
                        const std::function<Status(const std::string& temporary)>& write);

// Removes the temporary files of writes that are under way, for a signal handler that ends the
// process: it calls nothing but unlink.
void remove_temporaries();

// The same for bytes in memory.
Status write_text(const std::string& path, std::string_view bytes);

// Whether a file can be read; it must exist, be no folder and not be empty.
Status check_readable(const std::string& path);

// The whole content of a file that is not empty and has at most `limit` bytes.
Status read_bytes(const std::string& path, std::string* bytes,
                  std::size_t limit = std::size_t{1} << 34);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_IMAGES_ATOMIC_FILE_H_
