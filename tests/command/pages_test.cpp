// The pages tell the truth about the command: the README's examples run, and options exist.
#include <map>
#include <regex>
#include <vector>

#include "tests/command/run_command.h"

namespace obscura {
namespace {

class Pages : public CommandTest {};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at; (at = text.find(from)) != std::string::npos;) {
    text.replace(at, from.size(), to);
  }
  return text;
}

// In their order, in a small size; depth.exr and room.ply are made first.
TEST_F(Pages, TheReadmesExamplesRun) {
  expect_success("gbuffer scene:cornell?size=48x27 -q -o depth.exr");
  write("room.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "-1 0 -1\n1 0 -1\n0 2 -1\n3 0 1 2\n");
  const std::string page = read_file(OBSCURA_SOURCE_DIR "/README.md");
  const std::string begin = "\n    build/release/bin/obscura ";
  int found = 0;
  for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at + 1)) {
    const std::size_t from = at + begin.size();
    std::string arguments = page.substr(from, page.find('\n', from) - from);
    arguments = replaced(replaced(arguments, "1280x720", "48x27"), "--rays 256", "--rays 16");
    const CommandResult r = run(arguments + " -q");
    EXPECT_EQ(r.code, 0) << arguments << "\n" << r.err;
    ++found;
  }
  EXPECT_GE(found, 5);
}

// Every `obscura COMMAND ... --option` of a page is an option of that command. What `bench` and
// `reproduce` pass on to programs of their own is not looked at.
TEST_F(Pages, OptionsThatPagesNameExist) {
  namespace fs = std::filesystem;
  std::vector<fs::path> pages{OBSCURA_SOURCE_DIR "/README.md", OBSCURA_SOURCE_DIR "/CHANGELOG.md"};
  for (const auto& entry : fs::recursive_directory_iterator(OBSCURA_SOURCE_DIR "/docs")) {
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  }
  const std::regex command("(?:^|\\n    (?:build/release/bin/)?|`)obscura ([a-z]+)([^`]*)");
  const std::regex option("--[a-z][a-z-]*");
  std::map<std::string, std::string> help;
  int found = 0;
  for (const fs::path& page : pages) {
    const std::string text = read_file(page.string());
    for (std::sregex_iterator c(text.begin(), text.end(), command), end; c != end; ++c) {
      const std::string name = (*c)[1], prefix = c->str().substr(0, 1);
      std::string rest = (*c)[2];
      if (prefix == "\n") rest = rest.substr(0, rest.find('\n'));
      if (name == "bench" || name == "reproduce") continue;
      if (!help.count(name)) {
        const CommandResult r = run(name + " --help");
        EXPECT_EQ(r.code, 0) << page << ": there is no command " << name;
        help[name] = r.out;
      }
      for (std::sregex_iterator o(rest.begin(), rest.end(), option); o != end; ++o, ++found) {
        const std::regex whole("(^|[^a-z-])" + o->str() + "([^a-z-]|$)");
        EXPECT_TRUE(std::regex_search(help[name], whole))
            << page << ": obscura " << name << " has no option " << o->str();
      }
    }
  }
  EXPECT_GE(found, 20);
}

}  // namespace
}  // namespace obscura
