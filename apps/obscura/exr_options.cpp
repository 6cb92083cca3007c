#include "apps/obscura/exr_options.h"

#include "apps/obscura/choices.h"
#include "fmt/format.h"
#include "io/images/exr.h"

namespace obscura::app {

void ExrOptions::add_to(CLI::App* command) {
  auto add = [&](CLI::Option* option) {
    option->group("EXR results");
    return option;
  };
  CLI::Option* into =
      add(command
              ->add_option("--into", into_,
                           "Add the result to this EXR file instead of writing --output: all "
                           "else in it stays as it is")
              ->type_name("FILE"));
  add(command
          ->add_option("--into-part", part_,
                       "Part of it by name or number from 0; a new name makes a new part [default "
                       "the first]")
          ->type_name("PART")
          ->needs(into));
  add(command->add_flag("--replace", replace_, "Replace its channels of the same names")
          ->needs(into));
  add(command->add_option("--layer", layer_, "Layer of the channels: NAME.visibility and so on")
          ->type_name("NAME"));
  set_choices(add(command
                      ->add_option(
                          "--compression", compression_,
                          fmt::format("{} [default zip; with --into the part's own, zip where that "
                                      "loses bits]",
                                      tools::exr_compressions()))
                      ->type_name("NAME")),
              tools::exr_compressions());
  add(command->add_flag("--half", half_, "Write EXR channels as 16-bit floats"));
}

Status ExrOptions::check(const std::string& output) const {
  if (into() != output.empty()) {
    return invalid_argument(into() ? "--output and --into exclude each other"
                                   : "--output is required, or --into");
  }
  const std::string& path = target(output);
  const bool exr = tools::file_ending(path) == ".exr";
  const char* option = into()                  ? "--into"
                       : !layer_.empty()       ? "--layer"
                       : !compression_.empty() ? "--compression"
                                               : nullptr;
  if (option && !exr) {
    return invalid_argument(fmt::format("{} is for EXR files; {} is none", option, path));
  }
  return tools::check_exr_compression(compression_);
}

Status ExrOptions::write(const std::string& path, tools::WriteOptions options,
                         const std::optional<GuardBand>& guard_band, tools::Image* image) const {
  if (into()) {
    const tools::ExrAddOptions add{.half = half_,
                                   .compression = compression_,
                                   .part = part_,
                                   .layer = layer_,
                                   .replace = replace_,
                                   .made_by = options.made_by,
                                   .guard_band = guard_band};
    return tools::write_atomically(path, [&](const std::string& temporary) {
      return tools::add_to_exr(temporary, path, *image, add);
    });
  }
  if (!layer_.empty()) {
    for (tools::Image::Channel& c : image->channels) c.name = layer_ + "." + c.name;
  }
  options.half = half_;
  options.compression = compression_;
  return tools::write_image(path, *image, options);
}

}  // namespace obscura::app
