#ifndef OBSCURA_SCENE_VOLUMES_HISTOGRAM_H_
#define OBSCURA_SCENE_VOLUMES_HISTOGRAM_H_

#include "io/volumes/volume_image.h"

namespace obscura::tools {

// Values of a volume in bins of equal width from `min` to `max`. Whole numbers of at most 256
// different steps get a bin each, centred on the number; NaN and infinities are counted apart.
struct Histogram {
  double min = 0, max = 0;      // of the finite values
  double first = 0, width = 1;  // lower edge of bin 0, width of a bin
  double mean = 0;
  std::int64_t finite = 0, nan = 0, infinite = 0;
  std::vector<std::int64_t> bins;

  double edge(std::size_t bin) const { return first + width * double(bin); }
};

// Refuses a volume without a finite value.
Status make_histogram(const VolumeImage& image, Histogram* histogram);

// Otsu's threshold: the edge between bins that parts the values into two classes with the largest
// variance between them. Refuses a volume of one value, which no threshold parts.
Status otsu_threshold(const VolumeImage& image, const Histogram& histogram, double* threshold);

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_VOLUMES_HISTOGRAM_H_
