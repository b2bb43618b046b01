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
    throw InputError("--detector " + args.detector, "is what reads such images",
                     "give the detector that makes them, such as network");
  return params;
}

void throw_if_interrupted(const EdgeImageCounts& counts, const std::string& out) {
  if (interrupted())
    throw InputError(out, "interrupted after " + std::to_string(counts.all()) + " images",
                     "call again to go on");
}

int edges(const EdgesArguments& args) {
  EdgeImageOptions options;
  options.edges = params_of(args);
  check_apart(args.source.path, args.out);
  const std::unique_ptr<ImageSource> source = open_and_tell(args.source);
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
  if (counts.all() == counts.left_out)
    throw InputError(args.source.path, "gave no frame", "see `edgevo info` for what is in it");
  std::printf(
      "%s: %d images of edge probability, %d of them had been there%s; contact_sheet.jpg shows some\n",
      args.out.c_str(), counts.written + counts.kept, counts.kept,
      counts.left_out > 0 ? (", " + std::to_string(counts.left_out) + " frame(s) left out").c_str() : "");
  return 0;
}

}  // namespace

void add_edges_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand(
      "edges", "write the probability of an edge for every image, for --detector precomputed");
  auto args = std::make_shared<EdgesArguments>();
  add_source_options(*command, &args->source);
  add_image_scale(*command, &args->source);
  command
      ->add_option("-o,--out", args->out,
                   "folder for the images; those that are in it already are kept, so that an interrupted "
                   "call can be gone on with")
      ->required()
      ->check(path_given());
  command
      ->add_option("--detector", args->detector,
                   "whose probability: structured, network; of canny and edge_drawing the edge pixels")
      ->capture_default_str();
  command->add_option("--edge-model", args->model, "file of the detector, as for `edgevo run`")
      ->check(path_given());
  command->add_option("--jobs", args->jobs, "images at a time (default: as many as the machine has cores)")
      ->check(whole_number(1, 256));
  command->add_flag("--force", args->force, "write into a folder that holds something else");
  command->footer(
      "Then: edgevo run SOURCE --detector precomputed --edge-folder FOLDER -o OUT, with the same options of "
      "SOURCE.");
  command->callback([=] { *action = [=] { return edges(*args); }; });
}

}  // namespace edgevo::app
