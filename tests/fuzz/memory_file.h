#ifndef OBSCURA_TESTS_FUZZ_MEMORY_FILE_H_
#define OBSCURA_TESTS_FUZZ_MEMORY_FILE_H_

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <string>

namespace obscura::fuzz {

// A file in memory, by the name that a loader opens.
class MemoryFile {
 public:
  // Formats are told apart by the ending, which a link can have.
  MemoryFile(const std::uint8_t* data, std::size_t size, const std::string& ending)
      : file_(memfd_create("fuzz", 0)) {
    if (file_ < 0 || write(file_, data, size) != static_cast<ssize_t>(size)) std::abort();
    path_ = "/tmp/obscura-fuzz-" + std::to_string(getpid()) + ending;
    unlink(path_.c_str());
    const std::string target = "/proc/self/fd/" + std::to_string(file_);
    if (symlink(target.c_str(), path_.c_str()) != 0) std::abort();
  }
  ~MemoryFile() {
    unlink(path_.c_str());
    close(file_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  int file_;
  std::string path_;
};

}  // namespace obscura::fuzz

#endif  // OBSCURA_TESTS_FUZZ_MEMORY_FILE_H_
