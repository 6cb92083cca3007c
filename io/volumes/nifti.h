#ifndef OBSCURA_IO_VOLUMES_NIFTI_H_
#define OBSCURA_IO_VOLUMES_NIFTI_H_

#include "io/volumes/volume_image.h"

namespace obscura::tools {

// NIfTI-1 and NIfTI-2 in one file (.nii, .nii.gz), either byte order. The orientation is the
// sform's where it has right angles, else the qform's, else the bare spacing.
//
// Read here and not by a library: the common one prints to stderr and trusts the header's sizes.
//
// Of several volumes (dim[4] and beyond) the one that `index` counts from 0 is read.
Status read_nifti(const std::string& path, int index, VolumeImage* image);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_VOLUMES_NIFTI_H_
