#include "apps/obscura/work_folder.h"

#include <filesystem>

#include "fmt/format.h"
#include "io/images/files.h"

namespace obscura::app {

Status open_work_folder(const std::string& folder, const std::string& input,
                        const std::string& about) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    return {StatusCode::kInternal, fmt::format("cannot make {}: {}", folder, error.message())};
  }
  const auto changed = fs::last_write_time(input, error).time_since_epoch().count();
  const std::string text = fmt::format("{} input={} changed={}\n", about, input, changed);
  const std::string path = folder + "/about.txt";
  if (!fs::exists(path)) return tools::write_text(path, text);
  std::string other;
  if (Status s = tools::read_bytes(path, &other); !s.ok()) return s;
  if (other == text) return {};
  return invalid_argument(fmt::format(
      "{} holds parts of another run (see {}); remove it or give another name", folder, path));
}

}  // namespace obscura::app
