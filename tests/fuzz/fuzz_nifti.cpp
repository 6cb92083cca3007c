#include "io/volumes/nifti.h"

#include <cstdint>
#include <cstdlib>

#include "tests/fuzz/memory_file.h"

using namespace obscura;

// A volume that is read has the samples that its size promises.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const fuzz::MemoryFile file(data, size, ".nii");
  tools::VolumeImage image;
  if (!tools::read_nifti(file.path(), 0, &image).ok()) return 0;
  if (!tools::check_geometry(image).ok()) std::abort();
  std::size_t bytes = static_cast<std::size_t>(image.voxels());
  if (image.type == VoxelType::kI16 || image.type == VoxelType::kU16) bytes *= 2;
  if (image.type == VoxelType::kF32) bytes *= 4;
  if (image.samples.size() != bytes) std::abort();
  return 0;
}
