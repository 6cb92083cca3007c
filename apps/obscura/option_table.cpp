#include "apps/obscura/option_table.h"

#include "apps/obscura/choices.h"
#include "fmt/format.h"
#include "fmt/ranges.h"

namespace obscura::app {

std::string option_name(std::string field) {
  std::replace(field.begin(), field.end(), '_', '-');
  return field;
}

void OptionTable::declare_field(const std::string& label, const Field& field,
                                const std::string& expected, const std::string& default_value,
                                bool flag, bool repeatable) {
  Option& option = options_[field.name];
  if (option.labels.empty()) {
    order_.push_back(field.name);
    option.help = field.help;
    option.expected = expected;
    option.unit = field.unit;
    option.flag = flag;
    option.repeatable = repeatable;
  }
  option.labels.push_back(label);
  for (auto& [value, labels] : option.defaults) {
    if (value == default_value) {
      labels += ", " + label;
      return;
    }
  }
  option.defaults.emplace_back(default_value, label);
}

std::string OptionTable::help_text(const Option& o) const {
  std::string out = o.help + " [" + o.expected;
  if (!o.unit.empty()) out += ", " + o.unit;
  const bool for_all = o.labels.size() == labels_.size();
  std::string defaults;
  for (const auto& [value, labels] : o.defaults) {
    if (value.empty()) continue;
    defaults += defaults.empty() ? "; default " : ", ";
    defaults += value;
    if (o.defaults.size() > 1) defaults += " (" + labels + ")";
  }
  out += defaults;
  if (!for_all && o.defaults.size() == 1)
    out += "; for " + fmt::format("{}", fmt::join(o.labels, ", "));
  return out + "]";
}

void OptionTable::add_to(CLI::App* command, const std::string& group) {
  for (const std::string& field : order_) {
    Option& option = options_[field];
    const std::string name = option_name(field);
    option.option = option.flag ? command->add_flag(fmt::format("--{0},!--no-{0}", name),
                                                    option.text, help_text(option))
                                : command->add_option("--" + name, option.text, help_text(option));
    if (!option.flag) option.option->type_name("");
    if (option.repeatable) {
      option.option->delimiter(',')->multi_option_policy(CLI::MultiOptionPolicy::Join);
    }
    option.option->group(group);
    if (!option.words.empty()) set_choices(option.option, option.words);
  }
}

Status OptionTable::refuse_others(const std::string& label, const std::string& what) const {
  for (const auto& [field, option] : options_) {
    const bool has =
        std::find(option.labels.begin(), option.labels.end(), label) != option.labels.end();
    if (option.option->count() == 0 || has) continue;
    return invalid_argument(fmt::format("--{} does not apply to {}; it belongs to {}",
                                        option_name(field), what, fmt::join(option.labels, ", ")));
  }
  return {};
}

bool OptionTable::given(const std::string& field) const {
  const auto at = options_.find(field);
  return at != options_.end() && at->second.option->count() > 0;
}

}  // namespace obscura::app
