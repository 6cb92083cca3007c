#ifndef OBSCURA_IO_PICTURES_PICTURES_H_
#define OBSCURA_IO_PICTURES_PICTURES_H_

#include <string>
#include <vector>

#include "io/images/image.h"
#include "obscura/views.h"

namespace obscura::tools {

// Pictures for people: images with channels R, G, B (or one channel, Y) of values in [0, 1].

// One channel as it is.
Image grey_picture(const ImageView<const float>& values);

// Nearness on a logarithmic scale: white at the nearest depth, dark at the farthest, background
// black.
Image depth_picture(const ImageView<const float>& depth);

// Unit vectors as 0.5 + 0.5 n.
Image vector_picture(const VectorView<const float>& vectors);

// The far-field paper's error picture: white where the images agree, black from 20 % on; grey-blue
// where either has no value or `mask`, when given, is not finite. Where the reference is N times
// smaller, the image is read as in compare() and the picture has the reference's size.
Image error_picture(const ImageView<const float>& image, const ImageView<const float>& reference,
                    const ImageView<const float>& mask = {});

// Pictures of equal height side by side, each under its title.
struct Panel {
  std::string title;
  Image picture;
};
Image beside(const std::vector<Panel>& panels);

// Rows of panels on top of each other.
Image stack(const std::vector<Image>& rows);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_PICTURES_PICTURES_H_
