#include "reproduce/reproduce.h"

#include "fmt/format.h"
#include "io/images/files.h"

namespace obscura::tools {

Status ReproduceContext::picture(const std::string& what, const Image& image) const {
  return write_image(fmt::format("{}/{}-{}.png", folder_, name_, what), image);
}

Status ReproduceContext::plot(const std::string& what, const std::string& svg) const {
  return write_text(fmt::format("{}/{}-{}.svg", folder_, name_, what), svg);
}

Status reproduce(const Reproduction& reproduction, const std::string& folder,
                 const ReproduceContext& context) {
  Report report;
  report.settings["reproduction"] = reproduction.name;
  std::string text;
  if (Status s = reproduction.run(context, &report, &text); !s.ok()) return s;
  const std::string page = fmt::format("# {}\n\n{}\n\n{}\n{}", reproduction.name,
                                       reproduction.summary, report.to_markdown(), text);
  const std::string stem = fmt::format("{}/{}", folder, reproduction.name);
  if (Status s = write_text(stem + ".md", page); !s.ok()) return s;
  return write_text(stem + ".json", report.to_json());
}

}  // namespace obscura::tools
