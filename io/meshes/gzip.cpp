#include "io/meshes/gzip.h"

#include <fmt/format.h>
#include <zlib.h>

#include <fstream>
#include <vector>

namespace obscura::tools {

Status read_gzip(const std::string& path, std::string* contents) {
  constexpr std::size_t kLargest = std::size_t(4) << 30;
  std::ifstream file(path, std::ios::binary);
  if (!file) return invalid_input(fmt::format("{}: cannot be opened", path));
  z_stream stream{};
  constexpr int kGzipOnly = 16 + MAX_WBITS;
  if (inflateInit2(&stream, kGzipOnly) != Z_OK) {
    return {StatusCode::kOutOfMemory, "out of memory while inflating " + path};
  }
  std::string result;
  std::vector<char> in(1 << 16), out(1 << 18);
  int state = Z_OK;
  // Members may follow each other; the last one must be whole.
  while (state == Z_OK || state == Z_STREAM_END) {
    if (stream.avail_in == 0) {
      file.read(in.data(), std::streamsize(in.size()));
      stream.next_in = reinterpret_cast<Bytef*>(in.data());
      stream.avail_in = uInt(file.gcount());
      if (stream.avail_in == 0) break;
    }
    if (state == Z_STREAM_END && inflateReset(&stream) != Z_OK) break;
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = uInt(out.size());
    state = inflate(&stream, Z_NO_FLUSH);
    if (state == Z_BUF_ERROR) state = Z_OK;
    result.append(out.data(), out.size() - stream.avail_out);
    if (result.size() > kLargest) break;
  }
  inflateEnd(&stream);
  if (result.size() > kLargest) {
    return invalid_input(fmt::format("{}: inflates to more than 4 GiB", path));
  }
  if (state != Z_STREAM_END) {
    return invalid_input(fmt::format("{}: is not whole gzip data (corrupt or cut short)", path));
  }
  *contents = std::move(result);
  return {};
}

}  // namespace obscura::tools
