#ifndef OBSCURA_APPS_OBSCURA_VOLUME_INPUT_H_
#define OBSCURA_APPS_OBSCURA_VOLUME_INPUT_H_

#include <string>

#include "CLI/CLI.hpp"
#include "scene/volumes/load_volume.h"

namespace obscura::app {

// INPUT's options where it is a volume: the layout of .raw files and the clip box.
class VolumeInputOptions {
 public:
  void add_to(CLI::App* command);

  Status load(const std::string& path, int threads, tools::VolumeImage* image) const;
  // For volumes that are read plane by plane: refuses what only whole ones have.
  Status open(const std::string& path, tools::PlaneFile* file) const;
  // What was given, to tell runs apart.
  std::string text() const;

 private:
  Status read_layout(std::optional<tools::RawLayout>* raw) const;

  std::string size_, type_, spacing_, clip_;
  tools::VolumeChoice choice_;
  bool big_endian_ = false;
};

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_VOLUME_INPUT_H_
