#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <string_view>

#include "apps/obscura/app.h"
#include "apps/obscura/file_checks.h"
#include "apps/obscura/programs.h"
#include "fmt/format.h"
#include "io/images/exr.h"
#include "io/report/progress_bar.h"
#include "obscura/simd.h"
#include "obscura/version.h"

namespace obscura::app {
namespace {

// UTF-8 stays; '?' for bytes that are none, and for U+0080 to U+009F, which steer terminals.
std::string valid_utf8(const std::string& text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const auto byte = [&](std::size_t i) {
      return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0u;
    };
    const unsigned first = byte(0);
    std::size_t length = first < 0x80   ? 1
                         : first < 0xC2 ? 0
                         : first < 0xE0 ? 2
                         : first < 0xF0 ? 3
                                        : 4;
    // Control characters, spellings that are longer than need be, surrogates, beyond U+10FFFF.
    const bool low = byte(1) < 0xA0, lowest = byte(1) < 0x90;
    if (first > 0xF4 || (first == 0xC2 && low) || (first == 0xE0 && low) ||
        (first == 0xED && !low) || (first == 0xF0 && lowest) || (first == 0xF4 && !lowest)) {
      length = 0;
    }
    for (std::size_t i = 1; i < length; ++i) {
      if ((byte(i) & 0xC0) != 0x80) length = 0;
    }
    result += length > 0 ? text.substr(at, length) : "?";
    at += std::max<std::size_t>(length, 1);
  }
  return result;
}

// One line on stderr, whatever the message holds: no byte that could steer a terminal, long words
// (paths, tokens of damaged files) cut in their middle, at most 300 characters.
int fail(const std::string& message, int code) {
  constexpr std::size_t kLongestWord = 120, kLongest = 300 - std::string_view("obscura: ").size();
  std::string line;
  for (std::size_t at = 0; at < message.size();) {
    const std::size_t end = std::min(message.find(' ', at), message.size());
    std::string word = message.substr(at, end - at);
    for (char& c : word) {
      if (static_cast<unsigned char>(c) < ' ' || c == 127) c = ' ';
    }
    if (word.size() > kLongestWord) {
      word = word.substr(0, kLongestWord / 2) + "..." + word.substr(word.size() - kLongestWord / 2);
    }
    line += (line.empty() ? "" : " ") + word;
    at = end + 1;
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  if (line.size() > kLongest) line = line.substr(0, kLongest - 3) + "...";
  fmt::print(stderr, "obscura: {}\n", valid_utf8(line));
  return code;
}

int exit_code(const Status& status) {
  switch (status.code()) {
    case StatusCode::kOk:
      return kDone;
    case StatusCode::kInvalidArgument:
    case StatusCode::kUnsupported:
      return kBadUsage;
    case StatusCode::kInvalidInput:
      return kBadInput;
    default:
      return kFailure;
  }
}

int run(int argc, char** argv) {
  App app;
  app.cli.require_subcommand(1);
  app.cli.set_version_flag("--version", fmt::format("obscura {}", version()));
  app.cli.set_help_all_flag("--help-all", "Help of every command");
  add_ao(app);
  add_gbuffer(app);
  add_bake(app);
  add_compare(app);
  add_info(app);
  add_light(app);
  add_volume(app);
  add_terrain(app);
  add_demo(app);
  add_patterns(app);
  add_settings(app);
  add_manual(app);
  add_programs(app);
  bool known = argc < 2 || argv[1][0] == '-';
  std::string names;
  for (const CLI::App* command : app.cli.get_subcommands({})) {
    names += (names.empty() ? "" : ", ") + command->get_name();
    known = known || command->get_name() == argv[1];
  }
  if (argc < 2 || !known) {
    return fail(argc < 2
                    ? "say what to do; the commands are " + names
                    : fmt::format("there is no command '{}'; the commands are {}", argv[1], names),
                kBadUsage);
  }
  try {
    app.cli.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.cli.exit(e);  // --help, --version
  } catch (const CLI::ParseError& e) {
    return fail(e.what(), kBadUsage);
  }
  if (Status s = limit_simd_from_environment(); !s.ok()) return fail(s.message(), kBadUsage);
  for (const CLI::App* command : app.cli.get_subcommands()) {
    if (Status s = check_files(*command); !s.ok()) return fail(s.message(), exit_code(s));
  }
  tools::catch_interrupts();
  const Status status = app.action();
  if (!status.ok()) return fail(status.message(), exit_code(status));
  // A full disk or a closed pipe behind standard output shows only now.
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    return fail(fmt::format("cannot write to standard output: {}", std::strerror(errno)), kFailure);
  }
  return kDone;
}

}  // namespace

CLI::App* App::add_command(const std::string& name, const std::string& description,
                           std::function<Status()> run_command) {
  CLI::App* command = cli.add_subcommand(name, description);
  command->add_flag("-q,--quiet", quiet, "Print errors only");
  command->callback([this, run_command = std::move(run_command)] { action = run_command; });
  return command;
}

void add_threads_option(CLI::App* command, int* threads) {
  command
      ->add_option_function<int>(
          "--threads",
          [threads](int given) {
            *threads = given;
            tools::set_exr_threads(given);
          },
          "Threads; 0 uses all processors [0 to 1024, default 0]")
      ->check(CLI::Range(0, 1024))
      ->type_name("N");
}

}  // namespace obscura::app

int main(int argc, char** argv) {
  using namespace obscura::app;
  try {
    run_program(argv);
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    return fail("out of memory", kFailure);
  } catch (const std::exception& e) {
    return fail(e.what(), kFailure);
  }
}
