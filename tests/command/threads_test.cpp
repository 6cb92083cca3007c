// --threads 1 means one thread in every step of every command.
#include <sys/types.h>

#include <thread>

#include "tests/command/run_command.h"

namespace obscura {
namespace {

#if defined(__SANITIZE_THREAD__)
constexpr bool kThreadSanitizer = true;  // it has a thread of its own
#elif defined(__has_feature)
constexpr bool kThreadSanitizer = __has_feature(thread_sanitizer);
#else
constexpr bool kThreadSanitizer = false;
#endif

class ThreadsTest : public CommandTest {
 protected:
  void SetUp() override {
    if (kThreadSanitizer) GTEST_SKIP() << "the sanitizer has a thread of its own";
  }

  // The most threads that a command had at any time; workers stay until it ends.
  int most_threads(const std::string& arguments) {
    const std::string line = "cd '" + folder_ +
                             "'; export XDG_CACHE_HOME=$PWD/cache; exec '" OBSCURA_COMMAND "' " +
                             arguments + " >stdout.txt 2>stderr.txt </dev/null";
    const pid_t child = fork();
    if (child == 0) {
      execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
      _exit(127);
    }
    const std::string tasks = "/proc/" + std::to_string(child) + "/task";
    int most = 0, status = 0;
    while (waitpid(child, &status, WNOHANG) == 0) {
      std::error_code gone;
      int count = 0;
      for (auto at = std::filesystem::directory_iterator(tasks, gone);
           !gone && at != std::filesystem::directory_iterator(); at.increment(gone)) {
        ++count;
      }
      most = std::max(most, count);
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << arguments << "\n"
                                                               << read_file(path("stderr.txt"));
    return most;
  }
  void expect_one_thread(const std::string& arguments) {
    EXPECT_EQ(most_threads(arguments + " -q --threads 1"), 1) << arguments;
  }
};

// The count sees threads where there are some.
TEST_F(ThreadsTest, SeveralThreadsAreSeen) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "there is one processor";
  EXPECT_GT(most_threads("ao scene:hall --size 320x180 -o v.exr -q --threads 2"), 1);
}

TEST_F(ThreadsTest, AmbientVisibility) {
  expect_one_thread("gbuffer scene:hall?size=96x54 -o g.exr");
  for (const char* method : {"area", "far-field", "hemisphere", "horizon", "line", "mipmap",
                             "point", "ray-traced --rays 16"}) {
    expect_one_thread(std::string("ao g.exr -o v.exr --method ") + method);
  }
  expect_one_thread("ao g.exr -o v.exr --method line --resolution half");
  expect_one_thread("ao g.exr -o v.exr --keep-channels");
  expect_one_thread("ao scene:hall --size 96x54 -o v.exr --method geometric --rays 16");
}

TEST_F(ThreadsTest, Light) {
  const std::string light = "light scene:hall --size 96x54 -o lit.exr --no-cache ";
  for (const char* more :
       {"--technique ambient-occlusion", "--cones cosine", "--cones mean",
        "--method hemisphere --comparator samples", "--method hemisphere --comparator importance",
        "--method ray-traced --rays 16 --comparator samples"}) {
    expect_one_thread(light + "--environment sky " + more);
  }
  expect_one_thread(light + "--environment lit.exr");  // a file; it is twice as wide as high
}

TEST_F(ThreadsTest, Volume) {
  const std::string volume = "volume volume:sphere-over-plane?size=24 --size 64x48 -o v.exr ";
  for (const char* more :
       {"--light ao", "--light headlight", "--light shadow:1,1,2", "--light translucent:0.5",
        "--method monte-carlo --rays 16", "--fields v.nrrd --fields-of scalar"}) {
    expect_one_thread(volume + more);
  }
}

TEST_F(ThreadsTest, Demo) { expect_one_thread("demo --size 64x36 -o pictures"); }

}  // namespace
}  // namespace obscura
