#include "apps/obscura/completions.h"

#include <vector>

#include "apps/obscura/choices.h"
#include "fmt/format.h"

namespace obscura::app {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& cli) {
  return cli.get_subcommands([](const CLI::App*) { return true; });
}

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : " ") + word;
  return out;
}

// "--method --radius ... -o"
std::string options_of(const CLI::App& command) {
  std::string out;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) out += " --" + name;
    for (const std::string& name : option->get_snames()) out += " -" + name;
  }
  return out.empty() ? out : out.substr(1);
}

std::string command_names(const CLI::App& cli) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(cli)) names.push_back(command->get_name());
  return joined(names);
}

// The lines of a shell's `case` over "COMMAND --option", with the option's words.
std::string word_cases(const CLI::App& cli, const char* line) {
  std::string out;
  for (const CLI::App* command : commands_of(cli)) {
    for (const CLI::Option* option : command->get_options()) {
      if (choices_of(option).empty()) continue;
      out += fmt::format(fmt::runtime(line), command->get_name(), option->get_lnames().front(),
                         joined(choices_of(option)));
    }
  }
  return out;
}

std::string option_cases(const CLI::App& cli, const char* line) {
  std::string out;
  for (const CLI::App* command : commands_of(cli)) {
    out += fmt::format(fmt::runtime(line), command->get_name(), options_of(*command));
  }
  return out;
}

std::string bash(const CLI::App& cli) {
  return R"(# bash completion of obscura
_obscura() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} words=
  if [ "$COMP_CWORD" -eq 1 ]; then
    words=")" +
         command_names(cli) + R"( --help --version"
  else
    case "${COMP_WORDS[1]} $previous" in
)" + word_cases(cli, "      '{} --{}') words=\"{}\" ;;\n") +
         R"(      *)
        case "$current" in
          -*)
            case "${COMP_WORDS[1]}" in
)" + option_cases(cli, "              {}) words=\"{}\" ;;\n") +
         R"(            esac
            ;;
        esac
        ;;
    esac
  fi
  # Without words, files: see the last line.
  COMPREPLY=($(compgen -W "$words" -- "$current"))
}
complete -o default -o bashdefault -F _obscura obscura
)";
}

std::string zsh(const CLI::App& cli) {
  return R"(#compdef obscura
_obscura() {
  local all=
  if (( CURRENT == 2 )); then
    all=")" +
         command_names(cli) + R"( --help --version"
  else
    case "${words[2]} ${words[CURRENT-1]}" in
)" + word_cases(cli, "      '{} --{}') all=\"{}\" ;;\n") +
         R"(      *)
        case "$PREFIX" in
          -*)
            case "${words[2]}" in
)" + option_cases(cli, "              {}) all=\"{}\" ;;\n") +
         R"(            esac
            ;;
        esac
        ;;
    esac
  fi
  if [[ -n "$all" ]]; then
    compadd -- ${=all}
  else
    _files
  fi
}
# Called as a completion where it is autoloaded, and declared as one where it is sourced.
if [[ "$funcstack[1]" = "_obscura" ]]; then
  _obscura "$@"
else
  compdef _obscura obscura
fi
)";
}

std::string fish_quoted(const std::string& text) {
  std::string out = "'";
  for (char c : text) {
    if (c == '\\' || c == '\'') out += '\\';
    out += c;
  }
  return out + "'";
}

// What an option does, up to its first full stop or choice.
std::string short_help(const std::string& text) {
  return text.substr(0, std::min(text.find(" ["), text.find(". ")));
}

std::string fish(const CLI::App& cli) {
  std::string out = "# fish completion of obscura\n";
  for (const CLI::App* command : commands_of(cli)) {
    out += fmt::format("complete -c obscura -n __fish_use_subcommand -f -a {} -d {}\n",
                       command->get_name(), fish_quoted(short_help(command->get_description())));
  }
  for (const CLI::App* command : commands_of(cli)) {
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_lnames().empty()) continue;
      out += fmt::format("complete -c obscura -n '__fish_seen_subcommand_from {}' -l {}",
                         command->get_name(), option->get_lnames().front());
      for (const std::string& name : option->get_snames()) out += " -s " + name;
      if (!choices_of(option).empty()) {
        out += fmt::format(" -x -a {}", fish_quoted(joined(choices_of(option))));
      } else if (option->get_items_expected_max() > 0) {
        out += " -r";
      }
      out += fmt::format(" -d {}\n", fish_quoted(short_help(option->get_description())));
    }
  }
  return out;
}

}  // namespace

std::string completion_script(const CLI::App& cli, const std::string& shell) {
  if (shell == "bash") return bash(cli);
  if (shell == "zsh") return zsh(cli);
  return shell == "fish" ? fish(cli) : "";
}

}  // namespace obscura::app
