#ifndef OBSCURA_APPS_OBSCURA_LIGHT_FRAME_H_
#define OBSCURA_APPS_OBSCURA_LIGHT_FRAME_H_

#include <memory>
#include <string>

#include "apps/obscura/backend.h"
#include "apps/obscura/exr_options.h"
#include "apps/obscura/input.h"
#include "apps/obscura/methods.h"
#include "apps/obscura/sequence.h"
#include "io/environments/environment_file.h"
#include "obscura/lighting.h"

namespace obscura::app {

// The options of `obscura light`.
struct LightCommand {
  InputOptions input;
  MethodOptions method;
  BackendOptions backend;
  SequenceOptions sequence;
  OptionTable lighting;
  std::string environment, output, json;
  std::string albedo = "1,1,1", sun_direction, sun_irradiance = "3,3,3";
  double sun_radius_deg = 0.27, heading_deg = 0, pitch_deg = 0, exposure = 0;
  std::string cones = "cosine", comparator = "none";
  bool no_background = false, no_cache = false;
  ExrOptions exr;
  int threads = 0, supersample = 1;
};

// What all frames share.
struct LightShared {
  AnySettings method;
  MadeOnce once;
  LightingSettings lighting;  // but for world_from_eye
  float albedo[3] = {};
  tools::EnvironmentSource source;
  std::unique_ptr<Executor> executor;
  PreconvolvedEnvironment lights;
  Environment environment;  // where it is seen or compared with
  bool from_cache = false;
  double convolved = 0;  // seconds
};

// A picture: a depth image, mesh or scene lit. Both last as long as the frame.
std::unique_ptr<CommandFrame> make_light_frame(const LightCommand& command, LightShared* shared,
                                               FrameFiles files);

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_LIGHT_FRAME_H_
