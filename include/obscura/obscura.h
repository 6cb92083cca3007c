#ifndef OBSCURA_OBSCURA_H_
#define OBSCURA_OBSCURA_H_

// Everything in one include.

#include "obscura/area.h"
#include "obscura/camera.h"
#include "obscura/cone.h"
#include "obscura/depth_field.h"
#include "obscura/dual_radius.h"
#include "obscura/environment.h"
#include "obscura/estimator.h"
#include "obscura/executor.h"
#include "obscura/falloff.h"
#include "obscura/far_field.h"
#include "obscura/hemisphere.h"
#include "obscura/horizon.h"
#include "obscura/importance.h"
#include "obscura/lighting.h"
#include "obscura/line.h"
#include "obscura/mipmap.h"
#include "obscura/occluder.h"
#include "obscura/outputs.h"
#include "obscura/patterns.h"
#include "obscura/point.h"
#include "obscura/reference.h"
#include "obscura/settings.h"
#include "obscura/status.h"
#include "obscura/version.h"
#include "obscura/views.h"
#include "obscura/volume.h"

#endif  // OBSCURA_OBSCURA_H_
