// obscura-mpi: the fields of a volume by several processes, on one machine or many.
#include <exception>
#include <new>
#include <sstream>

#include "CLI/CLI.hpp"
#include "apps/mpi/volume_ranks.h"
#include "apps/obscura/option_table.h"
#include "apps/obscura/volume_input.h"
#include "fmt/format.h"
#include "io/images/atomic_file.h"
#include "io/images/files.h"
#include "io/report/progress_bar.h"
#include "io/report/stopwatch.h"
#include "obscura/simd.h"
#include "obscura/version.h"
#include "scene/volumes/volume_light.h"

namespace obscura::mpi {

// The library's settings as obscura volume names them.
struct FieldSettings {
  DistanceSettings distance{};
  OcclusionSettings occlusion{};
  tools::FieldsKind fields_of = tools::FieldsKind::kOctants;
};
template <FieldsOf<FieldSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  visit_fields(s.distance, [&](auto& value, Field field) {
    const std::string_view name = field.name;
    if (name == "isovalue") field.name = "iso";
    if (name == "start") field.name = "distance_start";
    v(value, field);
  });
  visit_fields(s.occlusion, [&](auto& value, Field field) {
    // Opacity comes with the light; slabs are swept as bytes.
    const std::string_view name = field.name;
    if (name == "transport") v(value, field);
  });
  v(s.fields_of, Field{"fields_of", "", {}, "What --fields writes."});
}

namespace {

struct Command {
  CLI::App cli{"Fields of volumes by several processes: mpirun -n 4 obscura-mpi volume ...",
               "obscura-mpi"};
  app::OptionTable table;
  app::VolumeInputOptions volume;
  std::string input, fields, light = "ao", planes;
  int threads = 1;
  bool quiet = false;

  Command() {
    cli.require_subcommand(1);
    cli.set_version_flag("--version", fmt::format("obscura-mpi {}", version()));
    CLI::App* command = cli.add_subcommand(
        "volume", "Ambient visibility or distances at every voxel, a slab of planes by each rank");
    command->add_option("INPUT", input, "Raw samples in one file: .raw, .nrrd or .nhdr")
        ->required()
        ->type_name("");
    command->add_option("--fields", fields, "NRRD file to write, in a folder that all ranks share")
        ->required()
        ->type_name("FILE");
    command->add_option("--light", light, "ao or translucent:ALPHA [default ao]")
        ->type_name("LIGHT");
    table.declare("volume", FieldSettings{});
    table.add_to(command, "Settings");
    volume.add_to(command);
    command
        ->add_option("--planes", planes,
                     "Planes of each rank, comma-separated [default as equal as may be]")
        ->type_name("LIST");
    command->add_option("--threads", threads, "Threads of each rank [0 to 1024, default 1]")
        ->check(CLI::Range(0, 1024))
        ->type_name("N");
    command->add_flag("-q,--quiet", quiet, "Print errors only");
  }

  Status job(VolumeJob* job) const {
    FieldSettings settings;
    if (Status s = table.read(&settings); !s.ok()) return s;
    if (!table.given("iso")) {
      return invalid_argument(
          "give --iso; no rank sees the whole volume's histogram. "
          "obscura info prints Otsu's threshold");
    }
    if (tools::file_ending(fields) != ".nrrd") {
      return invalid_argument(fmt::format("--fields is '{}'; it must end in .nrrd", fields));
    }
    tools::VolumeLight parsed;
    if (Status s = tools::parse_volume_light(light, &parsed); !s.ok()) {
      return {s.code(), "--" + s.message()};
    }
    if (parsed.kind != tools::VolumeLight::kAmbient &&
        parsed.kind != tools::VolumeLight::kTranslucent) {
      return invalid_argument(
          fmt::format("--light is '{}'; it must be ao or translucent:ALPHA", light));
    }
    job->output = fields;
    job->kind = settings.fields_of;
    job->distance = settings.distance;
    job->occlusion = settings.occlusion;
    job->occlusion.alpha = parsed.kind == tools::VolumeLight::kTranslucent ? parsed.alpha : 1.0f;
    job->threads = threads;
    std::istringstream list(planes);
    for (std::string word; std::getline(list, word, ',');) {
      double n = 0;
      if (!parse_number(word, &n) || !(n >= 1 && n <= 8192 && n == static_cast<int>(n))) {
        return invalid_argument(
            fmt::format("--planes is '{}'; it must be whole numbers such as 40,40,48", planes));
      }
      job->planes.push_back(static_cast<int>(n));
    }
    return {};
  }
};

Status run(const Ranks& ranks, int argc, char** argv) {
  Command command;
  std::string arguments;
  for (int i = 1; i < argc; ++i) arguments += fmt::format("{}{}", i > 1 ? " " : "", argv[i]);
  if (Status s = ranks.same("arguments", arguments); !s.ok()) return s;
  try {
    command.cli.parse(argc, argv);
  } catch (const CLI::Success& e) {
    if (ranks.first()) command.cli.exit(e);  // --help, --version
    return {};
  } catch (const CLI::ParseError& e) {
    return invalid_argument(e.what());
  }
  if (Status s = limit_simd_from_environment(); !s.ok()) return s;
  VolumeJob job;
  if (Status s = command.job(&job); !s.ok()) return s;
  tools::PlaneFile file;
  if (Status s = ranks.agree(command.volume.open(command.input, &file)); !s.ok()) return s;
  const tools::Stopwatch watch;
  VolumeTimes times;
  if (Status s = run_volume_job(ranks, file, job, &times); !s.ok()) return s;
  const auto n = file.volume().size;
  if (ranks.first() && !command.quiet) {
    fmt::print(
        "{}: {} of {}x{}x{} voxels by {} ranks, {:.2f} s; of rank 0: read {:.2f}, distances "
        "{:.2f}, light {:.2f}, write {:.2f}\n",
        job.output, enum_name(job.kind), n[0], n[1], n[2], ranks.count(), watch.seconds(),
        times.read, times.distance, times.light, times.write);
  }
  return {};
}

}  // namespace
}  // namespace obscura::mpi

int main(int argc, char** argv) {
  using namespace obscura::mpi;
  obscura::tools::catch_interrupts();
  const obscura::tools::IgnoreFileSizeSignal ignore_signal;
  const Ranks ranks(&argc, &argv);
  try {
    // Every rank comes to the same error.
    const obscura::Status status = run(ranks, argc, argv);
    if (!status.ok() && ranks.first()) print_error(status.message());
    return exit_code(status);
  } catch (const std::exception& e) {
    print_error(fmt::format("rank {}: {}", ranks.rank(), e.what()));
    MPI_Abort(MPI_COMM_WORLD, 1);
    return 1;
  }
}
