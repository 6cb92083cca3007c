#include <fcntl.h>
#include <signal.h>
#include <spawn.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <map>
#include <thread>

#include "tests/command/run_command.h"

// However a run ends: signals, full disks, names at the limit. Nothing half-written stays.
namespace obscura {
namespace {

class EndingsTest : public CommandTest {
 protected:
  // Starts the command in the folder, sends a signal after `wait`, and gives what waitpid says.
  int killed(const std::vector<std::string>& arguments, int signal,
             std::chrono::milliseconds wait) {
    std::vector<std::string> words{"sh", "-c",
                                   "cd '" + folder_ + "' && exec '" OBSCURA_COMMAND "'"};
    for (const std::string& a : arguments) words[2] += " '" + a + "'";
    words[2] += " >out.log 2>err.log";
    std::vector<char*> argv;
    for (std::string& w : words) argv.push_back(w.data());
    argv.push_back(nullptr);
    pid_t pid = 0;
    EXPECT_EQ(posix_spawnp(&pid, "sh", nullptr, nullptr, argv.data(), environ), 0);
    std::this_thread::sleep_for(wait);
    kill(pid, signal);
    const auto start = std::chrono::steady_clock::now();
    int status = 0;
    waitpid(pid, &status, 0);
    took_ = std::chrono::steady_clock::now() - start;
    std::filesystem::remove(path("out.log"));
    std::filesystem::remove(path("err.log"));
    return status;
  }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& f : std::filesystem::directory_iterator(folder_)) {
      names.push_back(f.path().filename().string());
    }
    return names;
  }

  std::chrono::duration<double> took_{};
};

TEST_F(EndingsTest, WhateverRunsEndsSoonAfterASignal) {
#ifdef __SANITIZE_THREAD__
  constexpr double kSeconds = 20;
#else
  constexpr double kSeconds = 5;
#endif
  const std::vector<std::vector<std::string>> commands = {
      {"patterns", "--check", "128"},
      {"ao", "scene:hall?size=1920x1080", "--method", "ray-traced", "--rays", "16384", "-o",
       "a.exr"},
      {"gbuffer", "scene:meadow?size=8000x6000", "-o", "g.exr"},
      {"volume", "volume:gyroid?size=700", "--fields", "f.nrrd", "-o", "v.png"}};
  for (const auto& command : commands) {
    for (const int signal : {SIGINT, SIGTERM}) {
      const int status = killed(command, signal, std::chrono::milliseconds(700));
      // A signal that comes before the command has begun ends it by itself.
      const bool early = WIFSIGNALED(status) && WTERMSIG(status) == signal;
      EXPECT_TRUE(early || (WIFEXITED(status) && WEXITSTATUS(status) == 1)) << command[0];
      // One second on an idle machine.
      EXPECT_LT(took_.count(), kSeconds) << command[0];
      EXPECT_TRUE(files().empty()) << command[0] << " left " << files()[0];
    }
  }
}

// A file that is being written has no name, so that even SIGKILL leaves nothing.
TEST_F(EndingsTest, KilledWhileWritingTheOldFileStays) {
  for (int i = 0; i < 12; ++i) {
    write("o.exr", "the old one");
    const int status =
        killed({"ao", "scene:cornell?size=1200x900", "--method", "line", "-o", "o.exr", "-q"},
               SIGKILL, std::chrono::milliseconds(60 * i));
    const bool done = WIFEXITED(status);
    ASSERT_EQ(files().size(), 1u) << i;
    if (!done) {
      const std::string content = read_file(path("o.exr"));
      EXPECT_TRUE(content == "the old one" || content.size() > 10000) << i;
    }
  }
}

// How many moments of a run are tried: OBSCURA_MOMENTS, or so many.
int moments(int otherwise) {
  const char* given = std::getenv("OBSCURA_MOMENTS");
  return given ? std::atoi(given) : otherwise;
}

struct Writer {
  std::vector<std::string> words;
  std::vector<std::string> outputs;
};
std::vector<Writer> writers() {
  return {
      {{"ao", "scene:cornell?size=300x200", "--method", "line", "-q", "-o", "o.exr"}, {"o.exr"}},
      {{"light", "scene:cornell?size=160x90", "--environment", "sky", "--no-cache", "-q", "-o",
        "o.exr"},
       {"o.exr"}},
      {{"gbuffer", "scene:hall?size=500x300", "-q", "-o", "o.exr"}, {"o.exr"}},
      {{"volume", "volume:gyroid?size=64", "--size", "64x64", "-q", "--fields", "f.nrrd", "-o",
        "v.exr"},
       {"f.nrrd", "v.exr"}}};
}

// A file is the old one or a whole new one, at whatever moment a run is ended; nothing else stays.
TEST_F(EndingsTest, EndedAtAnyMoment) {
  const int count = moments(4);
  for (const Writer& writer : writers()) {
    std::map<std::string, std::string> whole;
    ASSERT_EQ(killed(writer.words, 0, std::chrono::milliseconds(0)), 0) << writer.words[0];
    const double seconds = took_.count();
    for (const std::string& name : writer.outputs) whole[name] = read_file(path(name));
    for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
      for (int i = 0; i < count; ++i) {
        for (const std::string& name : writer.outputs) write(name, "the old one");
        const auto wait = std::chrono::duration<double>(1.1 * seconds * (i + 0.5) / count);
        const int status = killed(writer.words, signal,
                                  std::chrono::duration_cast<std::chrono::milliseconds>(wait));
        EXPECT_EQ(files().size(), writer.outputs.size()) << writer.words[0] << " " << signal;
        bool all_new = true;
        for (const std::string& name : writer.outputs) {
          const std::string content = read_file(path(name));
          all_new = all_new && content == whole[name];
          EXPECT_TRUE(content == "the old one" || content == whole[name]) << name << " " << signal;
        }
        // Who says that all is done has done it.
        EXPECT_TRUE(all_new || !WIFEXITED(status) || WEXITSTATUS(status) != 0) << writer.words[0];
      }
    }
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directory(folder_);
  }
}

// The program that measures papers again: pictures one by one, then its page.
TEST_F(EndingsTest, ReproductionsEndedAtAnyMoment) {
  if (!std::filesystem::exists(OBSCURA_COMMAND "-reproduce")) {
    GTEST_SKIP() << "obscura-reproduce is not built";
  }
  const std::vector<std::string> words = {"reproduce", "terrain-pictures", "-q", "-o", "."};
  ASSERT_EQ(killed(words, 0, std::chrono::milliseconds(0)), 0);
  const double seconds = took_.count();
  std::map<std::string, std::string> whole;
  for (const std::string& name : files()) whole[name] = read_file(path(name));
  ASSERT_GT(whole.size(), 3u);
  const int count = moments(2);
  for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
    for (int i = 0; i < count; ++i) {
      for (const auto& [name, content] : whole) write(name, "the old one");
      const auto wait = std::chrono::duration<double>(1.1 * seconds * (i + 0.5) / count);
      const int status =
          killed(words, signal, std::chrono::duration_cast<std::chrono::milliseconds>(wait));
      EXPECT_LT(took_.count(), 5);  // one second on an idle machine
      EXPECT_EQ(files().size(), whole.size()) << signal;
      for (const auto& [name, content] : whole) {
        const std::string now = read_file(path(name));
        const bool done = WIFEXITED(status) && WEXITSTATUS(status) == 0;
        EXPECT_TRUE(!done || now != "the old one") << name << " " << signal;
        if (now == "the old one") continue;
        // Page and report hold times, which differ; they end in the same way.
        const bool picture = name.ends_with(".png");
        EXPECT_TRUE(picture ? now == content : now.ends_with(content.substr(content.size() - 4)))
            << name << " " << signal;
      }
    }
  }
}

// Two runs share a cache that something else damages all the while: pictures do not depend on it.
TEST_F(EndingsTest, ADamagedCacheChangesNothing) {
  const std::string line =
      "'" OBSCURA_COMMAND "' light scene:cornell?size=64x36 --environment sky -q -o o.exr";
  const std::string shell = "cd '" + folder_ + "' && export XDG_CACHE_HOME=$PWD/cache && ";
  std::filesystem::create_directory(path("one"));
  std::filesystem::create_directory(path("two"));
  ASSERT_EQ(std::system((shell + "cd one && " + line).c_str()), 0);
  const std::string right = read_file(path("one/o.exr"));
  const std::string cache = path("cache/obscura");
  ASSERT_FALSE(std::filesystem::is_empty(cache));
  const std::string kept = read_file(std::filesystem::directory_iterator(cache)->path().string());
  std::atomic<bool> stop = false;
  int damaged = 0;
  std::thread attack([&] {
    for (; !stop; ++damaged) {
      std::string bad = kept;
      bad[bad.size() * (damaged % 7 + 1) / 8] ^= 1;
      if (damaged % 3 == 0) bad.resize(bad.size() * (damaged % 5) / 5);
      for (const auto& file : std::filesystem::directory_iterator(cache)) {
        std::ofstream(file.path(), std::ios::binary) << bad;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(3));
    }
  });
  for (int i = 0; i < 3; ++i) {
    const int status = std::system((shell + "{ (cd one && " + line + ") & a=$!; (cd two && " +
                                    line + ") & wait $a && wait $!; }")
                                       .c_str());
    EXPECT_EQ(status, 0);
    for (const char* name : {"one/o.exr", "two/o.exr"}) {
      EXPECT_TRUE(read_file(path(name)) == right) << name;
      std::filesystem::remove(path(name));
    }
  }
  stop = true;
  attack.join();
  EXPECT_GT(damaged, 3);
}

// A disk that is full after so many bytes, here as the largest file that may be written.
TEST_F(EndingsTest, FullDisks) {
#ifdef __SANITIZE_THREAD__
  // The sanitizer itself writes a file as it starts.
  const std::vector<double> shares = {0.5, 0.9, 0.99};
#else
  const std::vector<double> shares = {0.0, 0.1, 0.5, 0.9, 0.99};
#endif
  for (const Writer& writer : writers()) {
    std::string line;
    for (const std::string& word : writer.words) line += " '" + word + "'";
    std::uintmax_t largest = 0;
    ASSERT_EQ(run(line).code, 0);
    for (const std::string& name : writer.outputs) {
      largest = std::max(largest, std::filesystem::file_size(path(name)));
    }
    for (const double share : shares) {
      for (const std::string& name : writer.outputs) write(name, "the old one");
      const auto blocks = static_cast<long>(share * static_cast<double>(largest)) / 512;
      // The logs of run() are files too, so messages go elsewhere.
      const std::string shell = "cd '" + folder_ + "' && ulimit -f " + std::to_string(blocks) +
                                "; '" OBSCURA_COMMAND "' " + line + " >/dev/null 2>/dev/null";
      const int status = std::system(shell.c_str());
      EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << line << " " << share;
      bool old = false;
      for (const std::string& name : writer.outputs) {
        old = old || read_file(path(name)) == "the old one";
      }
      EXPECT_TRUE(old) << line << " " << share;
      for (const std::string& name : files()) {
        EXPECT_EQ(name.find(".obscura-"), std::string::npos) << name;
      }
    }
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directory(folder_);
  }
}

TEST_F(EndingsTest, StandardOutputThatCannotTakeItIsAFailure) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  for (const char* arguments : {"settings", "ao scene:cornell?size=32x32 -q -o a.exr --json -"}) {
    const std::string line = "cd '" + folder_ + "'; '" OBSCURA_COMMAND "' " +
                             std::string(arguments) + " >/dev/full 2>err.txt";
    const int status = std::system(line.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1) << arguments;
    EXPECT_NE(read_file(path("err.txt")).find("No space left"), std::string::npos) << arguments;
  }
}

TEST_F(EndingsTest, NamesMayHave255Bytes) {
  const std::string name = std::string(251, 'n') + ".exr";
  const CommandResult r = run("ao scene:cornell?size=16x16 -q -o " + name);
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(std::filesystem::exists(path(name)));
}

TEST_F(EndingsTest, MessagesAreShortAndPrintable) {
  write("p.ply", "ply\nformat ascii 1.0\n\x1b[2J" + std::string(5000, 'k') + " x\nend_header\n");
  const CommandResult r = run("ao p.ply --eye 0,0,1 --look-at 0,0,0 -o a.exr");
  EXPECT_EQ(r.code, 3);
  EXPECT_LE(r.err.size(), 301u);
  EXPECT_EQ(r.err.find('\x1b'), std::string::npos);
  expect_failure("ao scene:cornell --seed 1 --method line --samples 99 -o a.exr", 2, "[1, 32]");
  expect_failure("ao scene:cornell --method line --seed 4294967296 -o a.exr", 2, "4294967295");
}

}  // namespace
}  // namespace obscura
