#ifndef OBSCURA_APPS_OBSCURA_DESCRIBE_INPUT_H_
#define OBSCURA_APPS_OBSCURA_DESCRIBE_INPUT_H_

#include <string>

#include "io/report/json.h"
#include "obscura/status.h"

// What inputs that are neither images nor volumes hold, what is odd about them, and a command line
// that reads them.
namespace obscura::app {

// A mesh file: counts, bounding box, size.
Status describe_mesh(const std::string& path, tools::Json* description);

// A procedural scene: what it is, its parameters, what it is made of.
Status describe_scene(const std::string& spec, tools::Json* description);

// A projection matrix as text: its camera.
Status describe_projection(const std::string& path, tools::Json* description);

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_DESCRIBE_INPUT_H_
