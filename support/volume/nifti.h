#ifndef OBSCURA_SUPPORT_VOLUME_NIFTI_H_
#define OBSCURA_SUPPORT_VOLUME_NIFTI_H_

#include "support/volume/volume_image.h"

namespace obscura::support {

// NIfTI-1 and NIfTI-2 in one file (.nii, .nii.gz), either byte order. The orientation is the
// sform's where it has right angles, else the qform's, else the bare spacing.
//
// Read here and not by a library: the common one prints to stderr and trusts the header's sizes.
Status read_nifti(const std::string& path, VolumeImage* image);

}  // namespace obscura::support

#endif  // OBSCURA_SUPPORT_VOLUME_NIFTI_H_
