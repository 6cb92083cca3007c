#ifndef OBSCURA_APPS_OBSCURA_OUTPUT_H_
#define OBSCURA_APPS_OBSCURA_OUTPUT_H_

#include <string>
#include <vector>

#include "io/images/image.h"
#include "io/report/report.h"
#include "obscura/outputs.h"

namespace obscura::app {

// The results that --outputs can name and the channels that hold them in a file: one for scalars,
// NAME.X, NAME.Y and NAME.Z for vectors.
class OutputImages {
 public:
  // `names` is a comma-separated list such as "visibility,bent-normal".
  static Status parse(const std::string& names, OutputImages* outputs);

  // Whether a file of this ending can hold them: EXR any, PFM one scalar or vector, PNG one.
  Status check_file(const std::string& path) const;

  // Makes the channels at the visible size; the views write into image().
  Outputs allocate(int width, int height);

  tools::Image& image() { return image_; }
  const tools::Image& image() const { return image_; }

  static std::string all_names();

 private:
  std::vector<std::string> names_;
  tools::Image image_;
};

// Writes a report as JSON to `path` when it is not empty ("-" is standard output).
Status write_json(const tools::Report& report, const std::string& path);

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_OUTPUT_H_
