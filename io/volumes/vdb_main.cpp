// obscura-vdb FILE GRID: reads a grid of an OpenVDB file, the first that fits where GRID is empty,
// and writes it to standard output (io/volumes/vdb_native.h). OpenVDB trusts the bytes of a file;
// here they meet limits of memory and time. Not for use by hand.
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "io/volumes/vdb_native.h"

namespace {

void limit(int what, double amount) {
  rlimit r{};
  if (getrlimit(what, &r) != 0) return;
  const auto wanted = static_cast<rlim_t>(amount);
  r.rlim_cur = r.rlim_max == RLIM_INFINITY ? wanted : std::min(wanted, r.rlim_max);
  setrlimit(what, &r);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("obscura-vdb: reads OpenVDB files for obscura; not for use by hand\n", stderr);
    return 2;
  }
  // OpenVDB writes its warnings to standard output, where they would stand before the answer.
  std::FILE* answer = fdopen(dup(STDOUT_FILENO), "wb");
  if (!answer || !std::freopen("/dev/null", "w", stdout)) return 2;
  std::error_code error;
  const auto bytes = static_cast<double>(std::filesystem::file_size(argv[1], error));
  // Deflated and sparse trees become some tens of times as large in memory.
  const double tree = 400e6 + 100 * (error ? 0 : bytes);
  limit(RLIMIT_DATA, tree);
  limit(RLIMIT_CPU, 4 + bytes / 4e6);
  limit(RLIMIT_CORE, 0);
  obscura::tools::VolumeImage image;
  const auto status = obscura::tools::read_vdb_trusting(
      argv[1], argv[2],
      [&](double samples) {
        limit(RLIMIT_DATA, tree + samples);
        limit(RLIMIT_CPU, 8 + bytes / 4e6 + samples / 2e7);
      },
      &image);
  const std::string header = obscura::tools::write_vdb_header(status, image);
  std::fwrite(header.data(), 1, header.size(), answer);
  if (status.ok()) std::fwrite(image.samples.data(), 1, image.samples.size(), answer);
  const bool whole = std::fflush(answer) == 0;
  // Without the destructors of a tree that may be damaged.
  _exit(whole ? 0 : 1);
}
