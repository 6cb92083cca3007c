#ifndef OBSCURA_IO_IMAGES_EXR_CHECKED_FILE_H_
#define OBSCURA_IO_IMAGES_EXR_CHECKED_FILE_H_

#include <ImfIO.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>

namespace obscura::tools {

// A file of which every write is checked: OpenEXR's own streams lose what fails when they close,
// such as the last bytes on a disk that is full.
class CheckedFile : public Imf::OStream {
 public:
  explicit CheckedFile(const std::string& path)
      : Imf::OStream(path.c_str()), file_(std::fopen(path.c_str(), "wb")) {
    if (!file_) error_ = errno;
  }
  ~CheckedFile() override { close(); }
  CheckedFile(const CheckedFile&) = delete;
  CheckedFile& operator=(const CheckedFile&) = delete;

  void write(const char* bytes, int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (error_ == 0 && std::fwrite(bytes, 1, size, file_) != size) note_error();
    if (error_ != 0) throw std::runtime_error(std::strerror(error_));
  }
  // OpenEXR calls these in destructors: they only take note.
  std::uint64_t tellp() override {
    const long at = error_ == 0 ? std::ftell(file_) : 0;
    if (at < 0) note_error();
    return at < 0 ? 0 : static_cast<std::uint64_t>(at);
  }
  void seekp(std::uint64_t at) override {
    if (error_ == 0 && std::fseek(file_, static_cast<long>(at), SEEK_SET) != 0) note_error();
  }
  // 0, or the errno of the first thing that failed.
  int error() const { return error_; }
  int close() {
    if (file_ && std::fclose(file_) != 0 && error_ == 0) error_ = errno;
    file_ = nullptr;
    return error_;
  }

 private:
  void note_error() { error_ = errno != 0 ? errno : EIO; }

  std::FILE* file_;
  int error_ = 0;
};

}  // namespace obscura::tools

#endif  // OBSCURA_IO_IMAGES_EXR_CHECKED_FILE_H_
