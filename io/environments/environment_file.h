#ifndef OBSCURA_IO_ENVIRONMENTS_ENVIRONMENT_FILE_H_
#define OBSCURA_IO_ENVIRONMENTS_ENVIRONMENT_FILE_H_

#include <string>

#include "obscura/environment.h"
#include "obscura/lighting.h"

namespace obscura::tools {

// An environment as the command line names it: a latitude-longitude map in a .hdr, .exr or .pfm
// file, or "sky" with settings, "sky:turbidity=4,elevation-deg=20".
struct EnvironmentSource {
  std::string name;     // as given
  std::string content;  // the file's bytes, or the settings as text: what a cache goes by
  bool is_sky = false;
  SkySettings sky{};
};

// Reads a name and, of a file, the bytes.
Status open_environment(const std::string& name, EnvironmentSource* source);

// Decodes a file's map or makes the sky. `repairs` says what of a map was mended.
Status load_environment(const EnvironmentSource& source, Environment* environment,
                        EnvironmentRepairs* repairs, const RunOptions& options = {});

// The sentence for people, "" where nothing was mended.
std::string describe(const EnvironmentRepairs& repairs);

// The grammar of "sky", for help.
std::string sky_help();

}  // namespace obscura::tools

#endif  // OBSCURA_IO_ENVIRONMENTS_ENVIRONMENT_FILE_H_
