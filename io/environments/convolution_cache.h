#ifndef OBSCURA_IO_ENVIRONMENTS_CONVOLUTION_CACHE_H_
#define OBSCURA_IO_ENVIRONMENTS_CONVOLUTION_CACHE_H_

#include <string>

#include "io/environments/environment_file.h"
#include "obscura/lighting.h"

namespace obscura::tools {

// Pre-convolved environments on disk, found again by what they were made from.
struct ConvolutionCache {
  bool enabled = true;
  std::string folder = default_folder();

  // $XDG_CACHE_HOME/obscura, or ~/.cache/obscura; "" where neither is known, which disables it.
  static std::string default_folder();
  // The file for this content and these settings.
  std::string path(const EnvironmentSource& source, const PreconvolutionSettings& settings) const;
};

// The environment's convolution from the cache, or made now and kept. A cache file that is damaged,
// short or of another version is not used but replaced; one that cannot be written is no error.
// `environment` is loaded only where it is needed, and `repairs` and `from_cache` tell about it.
Status preconvolve(const EnvironmentSource& source, const PreconvolutionSettings& settings,
                   const ConvolutionCache& cache, PreconvolvedEnvironment* result,
                   EnvironmentRepairs* repairs, bool* from_cache, const RunOptions& options = {});

}  // namespace obscura::tools

#endif  // OBSCURA_IO_ENVIRONMENTS_CONVOLUTION_CACHE_H_
