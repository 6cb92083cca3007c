#include "io/meshes/file_bytes.h"

#include <fmt/format.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>
#include <vector>

namespace obscura::tools {

Status read_file_bytes(const std::string& path, std::string* bytes) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    return invalid_input(fmt::format("{}: there is no such file", path));
  }
  if (!std::filesystem::is_regular_file(status) && !std::filesystem::is_fifo(status)) {
    return invalid_input(fmt::format("{}: is not a file", path));
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) return invalid_input(fmt::format("{}: cannot be opened", path));
  std::string result;
  if (std::filesystem::is_regular_file(status)) {
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (!error) result.reserve(size);
  }
  std::vector<char> block(1 << 20);
  while (file) {
    file.read(block.data(), std::streamsize(block.size()));
    result.append(block.data(), std::size_t(file.gcount()));
  }
  if (file.bad()) return invalid_input(fmt::format("{}: cannot be read", path));
  if (result.empty()) return invalid_input(fmt::format("{}: is empty", path));
  *bytes = std::move(result);
  return {};
}

Status inflate_gzip(const std::string& path, const std::string& zipped, std::string* bytes) {
  const std::size_t most = (std::size_t{64} << 20) + 100 * zipped.size();
  z_stream stream{};
  constexpr int kGzipOnly = 16 + MAX_WBITS;
  if (inflateInit2(&stream, kGzipOnly) != Z_OK) {
    return {StatusCode::kOutOfMemory, "out of memory while inflating " + path};
  }
  std::string result;
  std::vector<char> out(1 << 18);
  std::size_t at = 0;
  int state = Z_OK;
  // Members may follow each other; the last one must be whole.
  while ((state == Z_OK || state == Z_STREAM_END) && result.size() <= most) {
    if (stream.avail_in == 0) {
      if (at == zipped.size()) break;
      const std::size_t part = std::min<std::size_t>(zipped.size() - at, 1 << 20);
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(zipped.data() + at));
      stream.avail_in = uInt(part);
      at += part;
    }
    if (state == Z_STREAM_END && inflateReset(&stream) != Z_OK) break;
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = uInt(out.size());
    state = inflate(&stream, Z_NO_FLUSH);
    if (state == Z_BUF_ERROR) state = Z_OK;
    result.append(out.data(), out.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (result.size() > most) {
    return invalid_input(fmt::format(
        "{}: inflates to more than {} bytes, over a hundred times its size; inflate it first if it "
        "is to be trusted",
        path, most));
  }
  if (state != Z_STREAM_END) {
    return invalid_input(fmt::format("{}: is not whole gzip data (corrupt or cut short)", path));
  }
  if (result.empty()) return invalid_input(fmt::format("{}: is empty", path));
  *bytes = std::move(result);
  return {};
}

}  // namespace obscura::tools
