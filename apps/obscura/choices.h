#ifndef OBSCURA_APPS_OBSCURA_CHOICES_H_
#define OBSCURA_APPS_OBSCURA_CHOICES_H_

#include <string>
#include <vector>

#include "CLI/CLI.hpp"

namespace obscura::app {

// The words that an option's value can be, for shells to complete: far-field, line and so on.
// Remembered beside the options, as CLI11 has no place for them.
void set_choices(const CLI::Option* option, std::vector<std::string> words);
// "a, b, c" as words.
void set_choices(const CLI::Option* option, const std::string& list);
// Empty where there are none.
const std::vector<std::string>& choices_of(const CLI::Option* option);

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_CHOICES_H_
