#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <string>

#include "io/images/depth_file.h"
#include "io/images/describe.h"

using namespace obscura;

namespace {

// A file in memory, by the name that the loader opens.
class MemoryFile {
 public:
  MemoryFile(const std::uint8_t* data, std::size_t size) : file_(memfd_create("fuzz", 0)) {
    if (file_ < 0 || write(file_, data, size) != static_cast<ssize_t>(size)) std::abort();
    // Formats are told apart by the ending, which a link can have.
    path_ = "/tmp/obscura-fuzz-" + std::to_string(getpid()) + ".exr";
    unlink(path_.c_str());
    const std::string target = "/proc/self/fd/" + std::to_string(file_);
    if (symlink(target.c_str(), path_.c_str()) != 0) std::abort();
  }
  ~MemoryFile() {
    unlink(path_.c_str());
    close(file_);
  }
  const std::string& path() const { return path_; }

 private:
  int file_;
  std::string path_;
};

}  // namespace

// What is loaded has the size that it says.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const MemoryFile file(data, size);
  tools::DepthFileOptions options;
  options.fov_y = 60;
  options.normal_space = size % 2 ? tools::NormalSpace::kWorld : tools::NormalSpace::kView;
  options.layers = 2;
  tools::DepthInput input;
  for (int pass = 0; pass < 2; ++pass) {
    if (tools::load_depth_input(file.path(), options, &input).ok()) {
      const std::size_t pixels = static_cast<std::size_t>(input.width) * input.height;
      if (input.depth.size() != pixels || input.field().visible().width < 1) std::abort();
      for (const auto* v : {&input.normal_x, &input.normal_y, &input.normal_z, &input.back_depth}) {
        if (!v->empty() && v->size() != pixels) std::abort();
      }
    }
    options.fov_y = {};  // now from the file's matrices
  }
  tools::Json description;
  if (tools::describe_image(file.path(), &description).ok()) {
    tools::description_text(description);
  }
  return 0;
}
