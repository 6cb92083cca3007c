// obscura manual and obscura completions: manual pages and shells' completions, made from the
// tables of options.
#include <algorithm>
#include <cstdio>
#include <memory>

#include "apps/obscura/app.h"
#include "apps/obscura/completions.h"
#include "fmt/format.h"
#include "obscura/version.h"

namespace obscura::app {
namespace {

// Text of a manual page: what roff would read as a command is escaped.
std::string roff(const std::string& text) {
  std::string out;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const bool starts = k == 0 || text[k - 1] == '\n';
    if (starts && (text[k] == '.' || text[k] == '\'')) out += "\\&";
    if (text[k] == '\\') {
      out += "\\e";
    } else if (text[k] == '-') {
      out += "\\-";
    } else if (text[k] == '~') {
      out += "\\(ti";
    } else if (text[k] == '^') {
      out += "\\(ha";
    } else {
      out += text[k];
    }
  }
  return out;
}

std::string heading(const std::string& name, const std::string& summary) {
  std::string title = name;
  std::transform(title.begin(), title.end(), title.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return fmt::format(".TH {} 1 \"\" \"obscura {}\" \"User commands\"\n.SH NAME\n{} \\- {}\n",
                     roff(title), version(), roff(name), roff(summary));
}

std::string option_text(const CLI::Option& option) {
  std::string names;
  for (const std::string& name : option.get_snames()) names += "\\fB\\-" + name + "\\fR, ";
  for (const std::string& name : option.get_lnames()) names += "\\fB\\-\\-" + roff(name) + "\\fR, ";
  if (names.empty()) {
    names = "\\fI" + option.get_name(true) + "\\fR";
  } else {
    names.resize(names.size() - 2);
    const bool takes = option.get_items_expected_max() > 0;
    // Without the check that CLI11 appends: "N:NONNEGATIVE".
    const std::string whole = option.get_type_name(), type = whole.substr(0, whole.find(':'));
    if (takes) names += " \\fI" + roff(type.empty() ? "VALUE" : type) + "\\fR";
  }
  return fmt::format(".TP\n{}\n{}\n", names, roff(option.get_description()));
}

// Options in their groups, in order of appearance.
std::string options_text(const CLI::App& app) {
  std::vector<std::string> groups;
  for (const CLI::Option* option : app.get_options()) {
    if (std::find(groups.begin(), groups.end(), option->get_group()) == groups.end()) {
      groups.push_back(option->get_group());
    }
  }
  std::string out;
  for (const std::string& group : groups) {
    if (group.empty()) continue;  // hidden
    out += group == "Options" || group == "OPTIONS" ? ".SH OPTIONS\n" : ".SS " + roff(group) + "\n";
    for (const CLI::Option* option : app.get_options()) {
      if (option->get_group() == group) out += option_text(*option);
    }
  }
  return out;
}

std::string page_of(const CLI::App& command) {
  const std::string& name = command.get_name();
  return heading("obscura-" + name, command.get_description()) +
         fmt::format(".SH SYNOPSIS\n.B obscura {}\n[\\fIOPTION\\fR...] [\\fIINPUT\\fR...]\n",
                     roff(name)) +
         options_text(command) + ".SH SEE ALSO\n.BR obscura (1)\n";
}

std::string page_of_all(const CLI::App& cli) {
  std::string out = heading("obscura", cli.get_description());
  out += ".SH SYNOPSIS\n.B obscura\n\\fICOMMAND\\fR [\\fIOPTION\\fR...]\n.SH COMMANDS\n";
  std::string pages;
  for (const CLI::App* command : cli.get_subcommands([](const CLI::App*) { return true; })) {
    const std::string name = command->get_name();
    out += fmt::format(".TP\n\\fB{}\\fR\n{}\n", roff(name), roff(command->get_description()));
    pages += fmt::format("{}.BR obscura\\-{} (1)", pages.empty() ? "" : ",\n", roff(name));
  }
  out += options_text(cli);
  out +=
      ".SH EXIT STATUS\n.TP\n0\nDone.\n.TP\n1\nSomething failed, such as a file that could not be "
      "written.\n.TP\n2\nThe command line is wrong.\n.TP\n3\nAn input is wrong.\n";
  return out + ".SH SEE ALSO\n" + pages + "\n";
}

}  // namespace

void add_manual(App& app) {
  auto page = std::make_shared<std::string>();
  CLI::App* manual = app.add_command(
      "manual", "Print the manual page of obscura or of one of its commands", [page, &app] {
        if (page->empty()) {
          std::fputs(page_of_all(app.cli).c_str(), stdout);
          return Status();
        }
        for (const CLI::App* command :
             app.cli.get_subcommands([](const CLI::App*) { return true; })) {
          if (command->get_name() != *page) continue;
          std::fputs(page_of(*command).c_str(), stdout);
          return Status();
        }
        return invalid_argument(fmt::format("there is no command '{}'", *page));
      });
  manual->add_option("COMMAND", *page, "The command [default obscura itself]")->type_name("");

  auto shell = std::make_shared<std::string>();
  CLI::App* completions = app.add_command(
      "completions", "Print a script that completes commands, options and methods in a shell",
      [shell, &app] {
        const std::string script = completion_script(app.cli, *shell);
        if (script.empty()) {
          return invalid_argument(
              fmt::format("SHELL is '{}'; it must be one of bash, zsh, fish", *shell));
        }
        std::fputs(script.c_str(), stdout);
        return Status();
      });
  completions->add_option("SHELL", *shell, "bash, zsh or fish")->required()->type_name("");
}

}  // namespace obscura::app
