#include <random>

#include "obscura/methods.h"
#include "tests/command/run_command.h"

// What a command takes is bounded by its input, not by its square.
namespace obscura {
namespace {

class WorkBoundsTest : public CommandTest {
 protected:
  // A depth image whose surface is rough everywhere.
  void write_rough(const std::string& name, int width, int height) {
    std::string bytes = "Pf\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1\n";
    std::mt19937 random(width);
    for (int i = 0; i < width * height; ++i) {
      const float depth = 3 + static_cast<float>(random() % 1000) / 1000;
      bytes.append(reinterpret_cast<const char*>(&depth), sizeof(depth));
    }
    write(name, bytes);
  }
};

// Addresses that a command may take, in kB; the limits are far below what a square needs.
constexpr const char* kLimits = "ulimit -v 1500000; timeout 60";

TEST_F(WorkBoundsTest, LongImages) {
  write_rough("wide.pfm", 65535, 1);
  write_rough("high.pfm", 1, 65535);
  write_rough("dot.pfm", 1, 1);
  for (const std::string_view method : method_names()) {
    for (const char* name : {"wide.pfm", "high.pfm", "dot.pfm"}) {
      std::string line = std::string("ao ") + name + " --fov-y 60 -q -o a.pfm --method ";
      line += method;
      if (method == "ray-traced") line += " --rays 4";
      const CommandResult r = run(line, kLimits);
      EXPECT_EQ(r.code, 0) << line << "\n" << r.err;
      EXPECT_GT(std::filesystem::file_size(path("a.pfm")), 4u);
      std::filesystem::remove(path("a.pfm"));
    }
  }
}

}  // namespace
}  // namespace obscura
