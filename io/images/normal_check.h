#ifndef OBSCURA_IO_IMAGES_NORMAL_CHECK_H_
#define OBSCURA_IO_IMAGES_NORMAL_CHECK_H_

#include <string>

#include "io/images/depth_input.h"

namespace obscura::tools {

// Compares a file's normals with those that its depth has, and says what space they are in.
//
// Normals that need no more than a sign or a scale are mended: negated, with z or y turned round,
// packed into [0, 1], left-handed. Normals that only a rotation explains are in world space: depth
// is used in their place, as the file has no matrix. Both are said in input->notes. Normals that
// nothing explains are refused; so is an image of them that lies in world space where `trusted` is
// the matrix that should have turned them. Files with too little smooth surface are believed.
//
// input->depth must be linear or distance, or NDC with its planes; `source` names what the normals
// came from in messages: "N.X, N.Y, N.Z".
Status check_normals(const std::string& source, bool turned_by_matrix, DepthInput* input);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_IMAGES_NORMAL_CHECK_H_
