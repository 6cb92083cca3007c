#ifndef OBSCURA_IO_PICTURES_DISPLAY_H_
#define OBSCURA_IO_PICTURES_DISPLAY_H_

#include "io/images/image.h"

// From linear light to what a screen shows.
namespace obscura::tools {

// Means of n x n pixels; both sides are multiples of n.
Image box_filtered(const Image& image, int n);

// Brightens by `exposure` stops, clips to [0, 1] and encodes as sRGB.
void to_srgb(double exposure, Image* image);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_PICTURES_DISPLAY_H_
