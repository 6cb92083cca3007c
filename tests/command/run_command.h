#ifndef OBSCURA_TESTS_COMMAND_RUN_COMMAND_H_
#define OBSCURA_TESTS_COMMAND_RUN_COMMAND_H_

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <unistd.h>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "paths.h"

namespace obscura {

struct CommandResult {
  int code = -1;  // exit code, or -1 where a signal ended the command
  std::string out, err;
};

inline std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// Shell text that limits the addresses of a command to 1.5 GB. Sanitizers take far more for
// themselves, so that they run without.
inline std::string address_limit() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return "";
#else
  return "ulimit -v 1500000; ";
#endif
}

// A test that runs the obscura command in a folder of its own.
class CommandTest : public testing::Test {
 protected:
  CommandTest() {
    std::string pattern = (std::filesystem::temp_directory_path() / "obscura-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~CommandTest() override { std::filesystem::remove_all(folder_); }

  // `before` is shell text that runs first, such as "ulimit -f 8;". What commands keep between runs
  // stays in the folder.
  CommandResult run(const std::string& arguments, const std::string& before = "") {
    const std::string line = "cd '" + folder_ + "'; export XDG_CACHE_HOME=$PWD/cache; " + before +
                             " '" OBSCURA_COMMAND "' " + arguments +
                             " >stdout.txt 2>stderr.txt </dev/null";
    const int status = std::system(line.c_str());
    CommandResult result;
    if (WIFEXITED(status)) result.code = WEXITSTATUS(status);
    result.out = read_file(path("stdout.txt"));
    result.err = read_file(path("stderr.txt"));
    return result;
  }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
  }
  // Fails with `code` and one line on stderr that holds `part`.
  void expect_failure(const std::string& arguments, int code, const std::string& part,
                      const std::string& before = "") {
    const CommandResult r = run(arguments, before);
    EXPECT_EQ(r.code, code) << arguments << "\n" << r.err;
    EXPECT_NE(r.err.find(part), std::string::npos) << arguments << "\n" << r.err;
    EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << arguments << "\n" << r.err;
  }
  void expect_success(const std::string& arguments) {
    const CommandResult r = run(arguments);
    EXPECT_EQ(r.code, 0) << arguments << "\n" << r.err;
    EXPECT_EQ(r.err, "") << arguments;
  }

  std::string folder_;
};

}  // namespace obscura

#endif  // OBSCURA_TESTS_COMMAND_RUN_COMMAND_H_
