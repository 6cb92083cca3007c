#include "apps/obscura/choices.h"

#include <algorithm>
#include <map>

namespace obscura::app {
namespace {

std::map<const CLI::Option*, std::vector<std::string>>& remembered() {
  static std::map<const CLI::Option*, std::vector<std::string>> map;
  return map;
}

}  // namespace

void set_choices(const CLI::Option* option, std::vector<std::string> words) {
  remembered()[option] = std::move(words);
}

void set_choices(const CLI::Option* option, const std::string& list) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t comma = std::min(list.find(", ", at), list.size());
    words.push_back(list.substr(at, comma - at));
    at = comma + 2;
  }
  set_choices(option, std::move(words));
}

const std::vector<std::string>& choices_of(const CLI::Option* option) {
  static const std::vector<std::string> none;
  const auto at = remembered().find(option);
  return at == remembered().end() ? none : at->second;
}

}  // namespace obscura::app
