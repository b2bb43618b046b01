#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "edgevo/core/error.h"
#include "edgevo/datasets/ground_truth.h"
#include "edgevo/mrpt_bridge/rawlog_writer.h"
#include "edgevo/results/rawlog_output.h"
#include "progress.h"
#include "source_options.h"

namespace edgevo::app {
namespace {

namespace fs = std::filesystem;

bool is_same_place(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::weakly_canonical(a, ignored) == fs::weakly_canonical(b, ignored);
}

// Neither the rawlog nor the folder of its images may be what is being read.
void check_output(const std::string& source, const std::string& rawlog) {
  if (!names_rawlog(rawlog))
    throw InputError(rawlog, "does not end in .rawlog",
                     "name the output OUT.rawlog, so that the MRPT tools know it");
  const fs::path images = rawlog_stem(rawlog) + "_Images";
  if (is_same_place(source, rawlog) || is_same_place(source, images) ||
      is_same_place(source + "/images", images))
    throw InputError(rawlog, "would overwrite its own source " + source, "give another name for the output");
}

int import(const SourceOptions& options, const std::string& rawlog) {
  check_output(options.path, rawlog);
  const auto source = open_source(options);
  const std::string truth = ground_truth_tum(options, *source);
  int count = 0;
  {
    Progress progress("importing", source->size());
    count = write_rawlog(*source, rawlog, truth, [&](int done) { progress.update(done); });
  }
  std::printf("%s\n", describe_rawlog(rawlog, count, !truth.empty()).c_str());
  return 0;
}

}  // namespace

void add_import_command(CLI::App& app, Action* action) {
  CLI::App* command =
      app.add_subcommand("import", "turn a source into an MRPT rawlog with its images beside it");
  auto options = std::make_shared<SourceOptions>();
  auto rawlog = std::make_shared<std::string>();
  add_source_options(*command, options.get());
  command->add_option("OUT.rawlog", *rawlog, "the rawlog to write; its images go to OUT_Images")->required();
  command->callback([=] { *action = [=] { return import(*options, *rawlog); }; });
}

}  // namespace edgevo::app
