// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <memory>
#include <thread>

#include "commands.h"
#include "edgevo/core/error.h"
#include "edgevo/core/params.h"
#include "edgevo/detectors/edge_images.h"
#include "edgevo/files/output_folder.h"
#include "option_checks.h"
#include "progress.h"
#include "signals.h"
#include "source_options.h"

namespace edgevo::app {
namespace {

struct EdgesArguments {
  SourceOptions source;
  std::string out, detector = "network", model;
  int jobs = int(std::max(1u, std::thread::hardware_concurrency()));
  bool force = false;
};

EdgeParams params_of(const EdgesArguments& args) {
  EdgeParams params;
  const VisitParams visit = [&](ParamVisitor& v) {
    const auto group = v.group("edges");
    params.visit(v);
  };
  set_param("edges.detector=" + args.detector, visit);
  params.model = args.model;
  if (args.detector.find("precomputed") != std::string::npos)
    throw InputError("--detector " + args.detector, "reads such images and cannot make them",
                     "give the detector that makes them, such as network");
  return params;
}

void throw_if_interrupted(const EdgeImageCounts& counts, const std::string& out) {
  if (interrupted())
    throw InputError(out, "interrupted after " + std::to_string(counts.all()) + " images",
                     "run the same command again to continue");
}

int edges(const EdgesArguments& args) {
  EdgeImageOptions options;
  options.edges = params_of(args);
  check_apart(args.source.path, args.out);
  const std::unique_ptr<ImageSource> source = open_source_with_notices(args.source);
  options.folder = args.out;
  options.source_path = args.source.path;
  options.threads = args.jobs;
  options.force = args.force;
  listen_to_signals();
  options.stop = interrupted;
  EdgeImageCounts counts;
  {
    Progress progress("edges", source->size());
    options.on_frame_done = [&](int done) { progress.update(done); };
    counts = write_edge_images(*source, options);
  }
  throw_if_interrupted(counts, args.out);
  if (counts.all() == counts.skipped)
    throw InputError(args.source.path, "has no frames", "see `edgevo info` for its contents");
  std::printf(
      "%s: %d images of edge probability, %d of them from before%s; contact_sheet.jpg shows a selection\n",
      args.out.c_str(), counts.written + counts.kept, counts.kept,
      counts.skipped > 0 ? (", " + std::to_string(counts.skipped) + " frame(s) skipped").c_str() : "");
  return 0;
}

}  // namespace

void add_edges_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand(
      "edges", "write an edge probability image for each frame, for --detector precomputed");
  auto args = std::make_shared<EdgesArguments>();
  add_source_options(*command, &args->source);
  add_image_scale(*command, &args->source);
  command
      ->add_option("-o,--out", args->out,
                   "folder for the images; images already there are kept, so that an interrupted call can be "
                   "resumed")
      ->required()
      ->check(path_given());
  command
      ->add_option("--detector", args->detector,
                   "detector: structured or network (probabilities), canny or edge_drawing (edge pixels)")
      ->capture_default_str();
  command->add_option("--edge-model", args->model, "model file of the detector, as for `edgevo run`")
      ->check(path_given());
  command->add_option("--jobs", args->jobs, "process N images at a time (default: the number of cores)")
      ->check(whole_number(1, 256));
  command->add_flag("--force", args->force, "write into a folder that holds other files");
  command->footer(
      "Next: edgevo run SOURCE --detector precomputed --edge-folder FOLDER -o OUT, with the same source "
      "options.");
  command->callback([=] { *action = [=] { return edges(*args); }; });
}

}  // namespace edgevo::app
