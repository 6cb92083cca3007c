// OpenVDB trusts the bytes of a file; a program of its own with limits reads it: obscura-vdb.
#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>

#include "io/images/atomic_file.h"
#include "io/volumes/vdb_native.h"

namespace obscura::tools {
namespace {

using Clock = std::chrono::steady_clock;

// Beside the program or library that this code is part of, or where it is installed.
std::string find_reader() {
  Dl_info info{};
  dladdr(reinterpret_cast<void*>(&parse_vdb_header), &info);
  std::error_code error;
  for (const char* self : {info.dli_fname, "/proc/self/exe"}) {
    if (!self) continue;
    const auto folder = std::filesystem::canonical(self, error).parent_path();
    for (const char* place :
         {"obscura-vdb", "../libexec/obscura/obscura-vdb", "../bin/obscura-vdb",
          "../../../libexec/obscura/obscura-vdb", "../../../../libexec/obscura/obscura-vdb"}) {
      const auto path = folder / place;
      if (access(path.c_str(), X_OK) == 0) return path.string();
    }
  }
  return "";
}

// The running child: killed and waited for, whatever happens.
class Child {
 public:
  ~Child() {
    if (out_ >= 0) close(out_);
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
  }

  Status start(const std::string& program, const std::string& path, const std::string& grid) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return {StatusCode::kInternal, "no pipe can be made"};
    out_ = ends[0];
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], 1);
    posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    std::string words[] = {program, path, grid};
    char* argv[] = {words[0].data(), words[1].data(), words[2].data(), nullptr};
    const int error = posix_spawn(&pid_, program.c_str(), &actions, nullptr, argv, environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    if (error == 0) return {};
    pid_ = 0;
    return {StatusCode::kInternal, fmt::format("{} cannot be started", program)};
  }

  // Up to `count` bytes; fewer where the child ended, or `until` has come.
  std::size_t read_some(char* to, std::size_t count, Clock::time_point until) {
    for (;;) {
      const auto left =
          std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
      if (left <= 0) {
        late_ = true;
        return 0;
      }
      pollfd wait{out_, POLLIN, 0};
      const int ready = poll(&wait, 1, static_cast<int>(std::min<std::int64_t>(left, 1000)));
      if (ready < 0 && errno != EINTR) return 0;
      if (ready <= 0) continue;
      const ssize_t got = read(out_, to, count);
      if (got >= 0) return static_cast<std::size_t>(got);
      if (errno != EINTR) return 0;
    }
  }
  bool late() const { return late_; }

 private:
  pid_t pid_ = 0;
  int out_ = -1;
  bool late_ = false;
};

Status ended(const std::string& path, const Child& child) {
  return invalid_input(
      fmt::format("{}: damaged: OpenVDB {} on it", path,
                  child.late() ? "does not come to an end" : "crashes or wants too much memory"));
}

}  // namespace

Status read_vdb(const std::string& path, const std::string& grid, VolumeImage* image) {
  if (Status s = check_readable(path); !s.ok()) return s;
  const std::string program = find_reader();
  if (program.empty()) {
    return unsupported(fmt::format(
        "{}: the program obscura-vdb, which reads OpenVDB files, is not beside this one", path));
  }
  std::error_code error;
  const auto bytes = static_cast<double>(std::filesystem::file_size(path, error));
  // A hundred times what an ordinary file takes.
  const auto allowed = std::chrono::duration<double>(4 + bytes / 4e6);
  const auto until = Clock::now() + std::chrono::duration_cast<Clock::duration>(allowed);
  Child child;
  if (Status s = child.start(program, path, grid); !s.ok()) return s;
  std::string text(1 << 16, '\0');
  std::size_t filled = 0, end = std::string::npos;
  while (end == std::string::npos && filled < text.size()) {
    const std::size_t got = child.read_some(text.data() + filled, text.size() - filled, until);
    if (got == 0) return ended(path, child);
    filled += got;
    end = std::string_view(text).substr(0, filled).find("\n\n");
  }
  if (end == std::string::npos) return ended(path, child);
  VolumeImage result;
  if (Status s = parse_vdb_header(path, text.substr(0, end + 1), &result); !s.ok()) return s;
  if (Status s = check_geometry(result); !s.ok()) return s;
  result.type = VoxelType::kF32;
  try {
    result.samples.resize(static_cast<std::size_t>(result.voxels()) * sizeof(float));
  } catch (const std::bad_alloc&) {
    return {StatusCode::kOutOfMemory, fmt::format("{}: does not fit in memory", path)};
  }
  auto* samples = reinterpret_cast<char*>(result.samples.data());
  std::size_t have = std::min(filled - (end + 2), result.samples.size());
  std::copy_n(text.data() + end + 2, have, samples);
  const auto dense = std::chrono::duration<double>(static_cast<double>(result.voxels()) / 5e6);
  const auto samples_until = until + std::chrono::duration_cast<Clock::duration>(dense);
  while (have < result.samples.size()) {
    const std::size_t got =
        child.read_some(samples + have, result.samples.size() - have, samples_until);
    if (got == 0) return ended(path, child);
    have += got;
  }
  *image = std::move(result);
  return {};
}

}  // namespace obscura::tools
