#ifndef OBSCURA_OBSCURA_H_
#define OBSCURA_OBSCURA_H_

// Everything in one include, but obscura/vulkan.h, which needs Vulkan's headers.

#include "obscura/camera.h"
#include "obscura/cone.h"
#include "obscura/depth_field.h"
#include "obscura/dual_radius.h"
#include "obscura/environment.h"
#include "obscura/estimator.h"
#include "obscura/executor.h"
#include "obscura/falloff.h"
#include "obscura/importance.h"
#include "obscura/lighting.h"
#include "obscura/methods.h"
#include "obscura/occluder.h"
#include "obscura/outputs.h"
#include "obscura/patterns.h"
#include "obscura/run_options.h"
#include "obscura/settings.h"
#include "obscura/status.h"
#include "obscura/surface.h"
#include "obscura/terrain.h"
#include "obscura/version.h"
#include "obscura/views.h"
#include "obscura/volume.h"
#include "obscura/volume_blocks.h"

#endif  // OBSCURA_OBSCURA_H_
