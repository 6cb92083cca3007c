#ifndef OBSCURA_APPS_OBSCURA_WORK_FOLDER_H_
#define OBSCURA_APPS_OBSCURA_WORK_FOLDER_H_

#include <string>

#include "obscura/status.h"

namespace obscura::app {

// Makes the folder of a run's parts, or finds that of the same run, which was ended. `about` is
// what makes parts belong together: parts of another raster or with other settings are not taken.
Status open_work_folder(const std::string& folder, const std::string& input,
                        const std::string& about);

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_WORK_FOLDER_H_
