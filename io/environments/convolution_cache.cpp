#include "io/environments/convolution_cache.h"

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <vector>

#include "fmt/format.h"
#include "io/images/files.h"
#include "obscura/version.h"

namespace obscura::tools {
namespace {

// FNV-1a; guards against accidents, not against attack.
std::uint64_t hash(std::string_view bytes, std::uint64_t state = 0xcbf29ce484222325) {
  for (const char c : bytes) state = (state ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return state;
}

// A cache file: this header as text, padded with spaces, then the sun and the table as floats of
// the machine's byte order, which the magic number in front of them gives away.
constexpr std::size_t kHeaderBytes = 256;
constexpr std::uint32_t kByteOrder = 0x01020304;

std::string header(const EnvironmentSource& source, const PreconvolutionSettings& settings) {
  std::string text = fmt::format("obscura convolution 1\nversion {}\ncontent {:016x} {} bytes\n",
                                 version(), hash(source.content), source.content.size());
  visit_fields(settings, [&](const auto& value, const Field& field) {
    text += fmt::format("{} {}\n", field.name, value);
  });
  text.resize(kHeaderBytes, ' ');
  return text;
}

struct Body {
  std::uint32_t byte_order = kByteOrder;
  Sun sun;
};

std::string pack(const std::string& head, const PreconvolvedEnvironment& e) {
  Body body;
  body.sun = e.sun();
  std::string bytes = head;
  bytes.append(reinterpret_cast<const char*>(&body), sizeof(body));
  bytes.append(reinterpret_cast<const char*>(e.table().data()), e.table().size_bytes());
  const std::uint64_t sum = hash(bytes);
  bytes.append(reinterpret_cast<const char*>(&sum), sizeof(sum));
  return bytes;
}

bool unpack(const std::string& bytes, const std::string& head,
            const PreconvolutionSettings& settings, PreconvolvedEnvironment* e) {
  const std::size_t count = PreconvolvedEnvironment::table_size(settings);
  const std::size_t before_sum = head.size() + sizeof(Body) + count * sizeof(float);
  std::uint64_t sum;
  if (bytes.size() != before_sum + sizeof(sum) || !bytes.starts_with(head)) return false;
  std::memcpy(&sum, bytes.data() + before_sum, sizeof(sum));
  if (sum != hash(std::string_view(bytes).substr(0, before_sum))) return false;
  Body body;
  std::memcpy(&body, bytes.data() + head.size(), sizeof(body));
  if (body.byte_order != kByteOrder) return false;
  std::vector<float> table(count);
  std::memcpy(table.data(), bytes.data() + head.size() + sizeof(body), count * sizeof(float));
  return PreconvolvedEnvironment::from_table(settings, table, body.sun, e).ok();
}

}  // namespace

std::string ConvolutionCache::default_folder() {
  auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string(value ? value : "");
  };
  // The XDG specification has relative paths ignored.
  if (const std::string xdg = variable("XDG_CACHE_HOME"); xdg.starts_with('/')) {
    return xdg + "/obscura";
  }
  const std::string home = variable("HOME");
  return home.empty() ? "" : home + "/.cache/obscura";
}

std::string ConvolutionCache::path(const EnvironmentSource& source,
                                   const PreconvolutionSettings& settings) const {
  return fmt::format("{}/{:016x}.convolution", folder, hash(header(source, settings)));
}

Status preconvolve(const EnvironmentSource& source, const PreconvolutionSettings& settings,
                   const ConvolutionCache& cache, PreconvolvedEnvironment* result,
                   EnvironmentRepairs* repairs, bool* from_cache, const RunOptions& options) {
  *repairs = {};
  *from_cache = false;
  const bool use_cache = cache.enabled && !cache.folder.empty();
  const std::string head = header(source, settings), path = cache.path(source, settings);
  std::error_code error;
  if (use_cache && std::filesystem::is_regular_file(path, error)) {
    std::string bytes;
    if (read_bytes(path, &bytes).ok() && unpack(bytes, head, settings, result)) {
      *from_cache = true;
      return {};
    }
  }
  Environment environment;
  if (Status s = load_environment(source, &environment, repairs, options); !s.ok()) {
    return s;
  }
  if (Status s = PreconvolvedEnvironment::make(environment, settings, result, options); !s.ok()) {
    return s;
  }
  // A map that had to be mended is not kept, so that the user is told each time.
  if (use_cache && !repairs->any()) {
    std::filesystem::create_directories(cache.folder, error);
    if (!error) (void)write_text(path, pack(head, *result));
  }
  return {};
}

}  // namespace obscura::tools
