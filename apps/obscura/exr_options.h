#ifndef OBSCURA_APPS_OBSCURA_EXR_OPTIONS_H_
#define OBSCURA_APPS_OBSCURA_EXR_OPTIONS_H_

#include <optional>
#include <string>

#include "CLI/CLI.hpp"
#include "io/images/files.h"
#include "obscura/camera.h"
#include "obscura/status.h"

namespace obscura::app {

// How a result is stored in an EXR file: as a file of its own (--output) or as further channels of
// a file that is there (--into).
class ExrOptions {
 public:
  // --into, --into-part, --layer, --replace, --compression and --half.
  void add_to(CLI::App* command);

  bool into() const { return !into_.empty(); }
  // The file that is written.
  const std::string& target(const std::string& output) const { return into() ? into_ : output; }

  // What can be wrong before anything is read.
  Status check(const std::string& output) const;

  // Writes a frame's image. `guard_band` says where it lies in the file that it goes into; nullopt
  // is that file's display window.
  Status write(const std::string& path, tools::WriteOptions options,
               const std::optional<GuardBand>& guard_band, tools::Image* image) const;

 private:
  std::string into_, part_, layer_, compression_;
  bool replace_ = false, half_ = false;
};

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_EXR_OPTIONS_H_
