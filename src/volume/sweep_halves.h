#ifndef OBSCURA_SRC_VOLUME_SWEEP_HALVES_H_
#define OBSCURA_SRC_VOLUME_SWEEP_HALVES_H_

#include <cstdint>

#include "core/progress.h"
#include "obscura/executor.h"
#include "obscura/volume.h"
#include "volume/visibility_field.h"

// What the sweeps of ambient occlusion and of a shadow share.

namespace obscura {

// The grid that visibility is swept on: its scheme, size and place.
void set_occlusion_grid(const GridView<const float>& distance, const OcclusionSettings& settings,
                        VisibilityFieldImpl* field);
// What tau is measured in (equation 7): the geometric mean of the spacing.
float occlusion_unit(const VisibilityFieldImpl& field);
// Transmittance of each of its voxels from the mean of the distances there.
void occlusion_tau(const GridView<const float>& distance, const VisibilityFieldImpl& field,
                   Executor& executor, std::uint8_t* tau);

// The same for a shadow: a grid turned so that its axis (1, 1, 1) points to the light, of unit
// length, around a whole volume. Refuses one that would be many times the volume.
Status set_shadow_grid(const std::array<int, 3>& size, const Vec3& spacing, const Vec3& light,
                       const OcclusionSettings& settings, VisibilityFieldImpl* field);
// Transmittances of the field's planes, of which the first is plane `begin` of the turned grid,
// where the sampler has distances.
void shadow_tau(const GridSampler& sample, const VisibilityFieldImpl& field, int begin,
                Executor& executor, std::uint8_t* tau);
// Scales it to unit length.
Status unit_light(std::array<float, 3>* to_light);

// Sweeps the halves of the field that are asked for (bit 0 and 1 of `halves`) through
// transmittances as bytes.
void sweep_halves(const std::uint8_t* tau, const OcclusionSettings& settings, int halves,
                  Executor& executor, Progress& progress, VisibilityFieldImpl* field);

Status check_sweep(const GridView<const float>& distance, const OcclusionSettings& settings);
Status sweep_out_of_memory();
Status sweep_cancelled();

}  // namespace obscura

#endif  // OBSCURA_SRC_VOLUME_SWEEP_HALVES_H_
