// Manual pages and completions, as man and the shells read them.
#include <regex>

#include "tests/command/run_command.h"

namespace obscura {
namespace {

class Manual : public CommandTest {
 protected:
  bool has(const char* program) {
    return std::system((std::string("command -v ") + program + " >/dev/null").c_str()) == 0;
  }
  // What a line of shell text prints.
  std::string output_of(const std::string& line) {
    const std::string command =
        "cd '" + folder_ + "'; export HOME=$PWD; { " + line + "\n} >out.txt 2>&1 </dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0) << read_file(path("out.txt"));
    return read_file(path("out.txt"));
  }
};

TEST_F(Manual, PagesHaveNoWarningsAndEveryOption) {
  if (!has("man")) GTEST_SKIP() << "no man (package man-db)";
  const CommandResult all = run("manual");
  ASSERT_EQ(all.code, 0) << all.err;
  write("obscura.1", all.out);
  const std::regex name("\\.BR obscura\\\\-([a-z]+) \\(1\\)");
  int found = 0;
  for (std::sregex_iterator m(all.out.begin(), all.out.end(), name), end; m != end; ++m, ++found) {
    const std::string command = (*m)[1];
    const CommandResult page = run("manual " + command);
    EXPECT_EQ(page.code, 0) << page.err;
    write("obscura-" + command + ".1", page.out);
  }
  EXPECT_GE(found, 10);
  EXPECT_EQ(output_of("for p in *.1; do MANROFFSEQ= LC_ALL=C.UTF-8 MANWIDTH=80 man --warnings -E "
                      "UTF-8 -l -Tutf8 -Z \"$p\" >/dev/null; done"),
            "");
  const std::string text = output_of("LC_ALL=C.UTF-8 MANWIDTH=200 man -l obscura-ao.1 | col -b");
  for (const char* option : {"--method", "--frames", "--into", "--radius", "--threads"}) {
    EXPECT_NE(text.find(option), text.npos) << option;
  }
  expect_failure("manual nothing", 2, "there is no command 'nothing'");
}

TEST_F(Manual, BashCompletesAMethod) {
  ASSERT_EQ(run("completions bash").code, 0);
  write("obscura.bash", run("completions bash").out);
  const std::string complete =
      "bash -c 'source ./obscura.bash; COMP_WORDS=(obscura %); COMP_CWORD=$((${#COMP_WORDS[@]} - "
      "1)); _obscura; echo \"${COMPREPLY[*]}\"'";
  auto of = [&](const std::string& words) {
    return output_of(std::string(complete).replace(complete.find('%'), 1, words));
  };
  EXPECT_EQ(of("ao d.exr --method far"), "far-field\n");
  EXPECT_EQ(of("ao d.exr --skip"), "--skip-existing\n");
  EXPECT_EQ(of("gbuf"), "gbuffer\n");
  EXPECT_EQ(of("ao d.e"), "\n");  // files, by complete -o default
}

TEST_F(Manual, FishCompletesAMethod) {
  if (!has("fish")) GTEST_SKIP() << "no fish";
  write("obscura.fish", run("completions fish").out);
  auto of = [&](const std::string& line) {
    return output_of("fish --no-config -c 'source obscura.fish; complete -C \"" + line + "\"'");
  };
  EXPECT_EQ(of("obscura ao d.exr --method far").substr(0, 9), "far-field");
  EXPECT_EQ(of("obscura ao d.exr --skip").substr(0, 15), "--skip-existing");
}

// In a terminal of its own, with the key that a user presses.
TEST_F(Manual, ZshCompletesAMethod) {
  if (!has("zsh")) GTEST_SKIP() << "no zsh";
  std::filesystem::create_directory(path("functions"));
  write("functions/_obscura", run("completions zsh").out);
  write(
      "press.zsh",
      "zmodload zsh/zpty\n"
      "zpty shell 'TERM=dumb zsh -f -i'\n"
      "zpty -w shell 'PS1=; fpath=($PWD/functions $fpath); autoload -U compinit; compinit -u -D'\n"
      "zpty -w shell 'echo rea\"\"dy'\n"
      "zpty -r -m shell text '*ready*'\n"
      "zpty -w -n shell $'obscura ao d.exr --method far-\\t'\n"
      "zpty -r -m shell text '*method far-field*'\n"
      "print -r -- \"$text\"\n");
  EXPECT_NE(output_of("timeout 20 zsh -f press.zsh").find("ao d.exr --method far-field"),
            std::string::npos);
}

}  // namespace
}  // namespace obscura
