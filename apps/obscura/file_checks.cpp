#include "apps/obscura/file_checks.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "fmt/format.h"
#include "io/sequences/frame_names.h"

namespace obscura::app {
namespace {

namespace fs = std::filesystem;

// Options that name files, whichever command has them.
constexpr const char* kOutputs[] = {"output", "into", "fields", "picture", "error-image", "json"};
constexpr const char* kInputs[] = {
    "INPUT", "A", "B", "FILE", "mask", "environment", "projection", "world-to-camera", "cameras"};

struct NamedFile {
  std::string option, path;
};

template <std::size_t N>
std::vector<NamedFile> files_of(const CLI::App& command, const char* const (&names)[N]) {
  std::vector<NamedFile> files;
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_single_name();
    if (option->count() == 0 || std::find(names, names + N, name) == names + N) continue;
    files.push_back({option->get_positional() ? name : "--" + name, option->results().back()});
  }
  return files;
}

// Pipes and devices hold nothing that could be lost.
bool can_be_lost(const std::string& path) {
  std::error_code error;
  return path != "-" && (fs::is_regular_file(path, error) || !fs::exists(path, error));
}

bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::exists(a, error) && fs::exists(b, error)) return fs::equivalent(a, b, error);
  return fs::weakly_canonical(fs::absolute(a, error), error) ==
         fs::weakly_canonical(fs::absolute(b, error), error);
}

Status check_writable(const NamedFile& file) {
  auto cannot = [&](const std::string& reason) {
    return Status{StatusCode::kInternal,
                  fmt::format("cannot write {} {}: {}", file.option, file.path, reason)};
  };
  std::error_code error;
  if (fs::is_directory(file.path, error)) return cannot("it is a folder");
  if (!can_be_lost(file.path)) return {};
  std::string folder = fs::path(file.path).parent_path().string();
  if (folder.empty()) folder = ".";
  if (tools::has_frame_number(folder)) return {};
  if (!fs::is_directory(folder, error)) return cannot("there is no folder " + folder);
  if (access(folder.c_str(), W_OK | X_OK) != 0) return cannot(std::strerror(errno));
  // A name that the file system cannot have.
  if (access(file.path.c_str(), F_OK) != 0 && errno == ENAMETOOLONG) {
    return cannot(std::strerror(ENAMETOOLONG));
  }
  return {};
}

}  // namespace

Status check_files(const CLI::App& command) {
  const std::vector<NamedFile> outputs = files_of(command, kOutputs);
  const std::vector<NamedFile> inputs = files_of(command, kInputs);
  const CLI::Option* keep = command.get_option_no_throw("--keep-channels");
  const bool keeps = keep && keep->count() > 0;
  for (auto out = outputs.begin(); out != outputs.end(); ++out) {
    // Folders, as those of a demo, are made.
    const CLI::Option* option = command.get_option_no_throw(out->option);
    if (option->get_type_name() == "FOLDER") continue;
    if (can_be_lost(out->path)) {
      for (auto other = outputs.begin(); other != out; ++other) {
        if (!same_file(out->path, other->path)) continue;
        return invalid_argument(fmt::format("{} {} and {} are the same file; give two names",
                                            other->option, other->path, out->option));
      }
      for (const NamedFile& in : inputs) {
        const bool may = in.option == "INPUT" &&
                         (out->option == "--into" || (out->option == "--output" && keeps));
        if (may || !same_file(out->path, in.path)) continue;
        return invalid_argument(
            fmt::format("{} {} is {} too; a result must not replace what it "
                        "is made of",
                        out->option, out->path, in.option));
      }
    }
    if (Status s = check_writable(*out); !s.ok()) return s;
  }
  return {};
}

}  // namespace obscura::app
