#ifndef OBSCURA_REPRODUCE_REPRODUCE_H_
#define OBSCURA_REPRODUCE_REPRODUCE_H_

#include <functional>
#include <string>
#include <vector>

#include "io/images/image.h"
#include "io/report/report.h"

namespace obscura::tools {

// Where a reproduction puts what it makes, and what it may use.
class ReproduceContext {
 public:
  ReproduceContext(std::string folder, std::string name, int threads, std::string data,
                   std::function<bool(const std::string&, double)> progress)
      : threads(threads),
        data(std::move(data)),
        folder_(std::move(folder)),
        name_(std::move(name)),
        progress_(std::move(progress)) {}

  // Writes FOLDER/NAME-what.png, .svg or .exr.
  Status picture(const std::string& what, const Image& image) const;
  Status plot(const std::string& what, const std::string& svg) const;

  // Tells what is being done and the share of the whole that is done; false: stop.
  bool step(const std::string& what, double share) const { return progress_(what, share); }

  const int threads;       // as for make_executor
  const std::string data;  // a folder with further inputs (meshes, volumes, images), or ""

 private:
  std::string folder_, name_;
  std::function<bool(const std::string&, double)> progress_;
};

// One of the papers' tables or figures, measured again with our code. `run` fills the report, whose
// rows become NAME.json and a table in NAME.md, and may add paragraphs to the text of that page.
struct Reproduction {
  const char* name;     // ffao-table1
  const char* summary;  // what it shows, in a sentence
  Status (*run)(const ReproduceContext& context, Report* report, std::string* text);
};

// All of them, in the order of the papers.
const std::vector<Reproduction>& reproductions();

// Runs one and writes its Markdown and JSON beside its pictures.
Status reproduce(const Reproduction& reproduction, const std::string& folder,
                 const ReproduceContext& context);

}  // namespace obscura::tools

#endif  // OBSCURA_REPRODUCE_REPRODUCE_H_
