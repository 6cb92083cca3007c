#ifndef OBSCURA_APPS_OBSCURA_VOLUME_STREAM_H_
#define OBSCURA_APPS_OBSCURA_VOLUME_STREAM_H_

#include "apps/obscura/volume_command.h"

namespace obscura::app {

// The fields of a volume that may be larger than memory: slabs of planes that take at most so many
// bytes, from file to file in the folder OUTPUT.work. A run that was ended goes on after the last
// pass that it finished.
Status stream_volume(const VolumeCommand& command, const VolumeRequest& request, Executor* executor,
                     bool quiet);

// Bytes that the planes of a slab take, and what is taken whatever their number.
struct StreamBytes {
  double fixed = 0, plane = 0;
};
StreamBytes stream_bytes(const tools::VolumeImage& volume, tools::FieldsKind kind,
                         Transport transport, int threads);

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_VOLUME_STREAM_H_
