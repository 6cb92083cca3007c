// obscura settings: every method's settings as the Markdown page docs/settings.md.
#include <cstdio>

#include "apps/obscura/app.h"
#include "apps/obscura/methods.h"

namespace obscura::app {

void add_settings(App& app) {
  app.add_command("settings", "Print every method's settings as Markdown (docs/settings.md)", [] {
    std::fputs(settings_markdown().c_str(), stdout);
    return Status();
  });
}

}  // namespace obscura::app
