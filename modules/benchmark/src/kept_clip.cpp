// SPDX-License-Identifier: BSD-3-Clause
#include "kept_clip.h"

#include <cmath>
#include <filesystem>
#include <limits>

#include "edgevo/core/input_file.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/params.h"
#include "edgevo/datasets/open_source.h"
#include "edgevo/simulation/folder_export.h"

namespace edgevo {
namespace {

constexpr double kAny = std::numeric_limits<double>::max();
constexpr const char* kRemedy = "remove the folder `workflow` of the benchmark and call again";

// clip.yaml: numbers in a form that is read back exactly.
struct ClipFacts {
  std::string kind;
  int first = 0;
  Camera camera;

  void visit(KeyVisitor& v) {
    v.text("kind", kind, {}, "");
    v.integer("first", first, 0, std::numeric_limits<int>::max(), "");
    visit_camera(v);
  }
  void visit_camera(KeyVisitor& v) {
    Pinhole p = camera.pinhole();
    Distortion d = camera.distortion();
    const std::pair<const char*, double*> numbers[] = {{"fx", &p.fx}, {"fy", &p.fy}, {"cx", &p.cx},
                                                       {"cy", &p.cy}, {"k1", &d.k1}, {"k2", &d.k2},
                                                       {"p1", &d.p1}, {"p2", &d.p2}, {"k3", &d.k3}};
    for (const auto& [name, value] : numbers) v.number(name, *value, -kAny, kAny, "");
    v.integer("width", p.width, 1, std::numeric_limits<int>::max(), "");
    v.integer("height", p.height, 1, std::numeric_limits<int>::max(), "");
    camera = Camera(p, d);
  }
};

std::string in(const std::string& folder, const char* name) {
  return (std::filesystem::path(folder) / name).string();
}

ClipFacts read_facts(const std::string& folder) {
  ClipFacts facts;
  read_params_file(in(folder, "clip.yaml"), [&](ParamVisitor& v) { facts.visit(v); });
  return facts;
}

}  // namespace

void keep_clip(const SceneRenderer& renderer, int begin, int end, const std::string& kind, int threads,
               const std::string& folder) {
  FolderExport range;
  range.begin = begin, range.end = end, range.threads = threads;
  clear_sequence(folder);
  export_folder(renderer, folder, range);
  ClipFacts facts{kind, begin, renderer.scene().camera};
  write_file(in(folder, "clip.yaml"), write_params([&](ParamVisitor& v) { facts.visit(v); }));
}

bool is_kept_clip(const std::string& folder) {
  std::error_code ignored;
  return !folder.empty() && std::filesystem::is_regular_file(in(folder, "clip.yaml"), ignored);
}

std::shared_ptr<const Clip> read_kept_clip(const std::string& folder, std::string* ground_truth) {
  const ClipFacts facts = read_facts(folder);
  SourceOptions options;
  options.path = folder;
  const std::unique_ptr<ImageSource> source = open_source(options);
  auto clip = std::make_shared<Clip>(*read_clip(*source, [](int) { return true; }));
  clip->camera = facts.camera, clip->kind = facts.kind;
  for (Frame& frame : clip->frames) frame.index += facts.first, frame.image_path.clear();
  *ground_truth = read_file(in(folder, "groundtruth_tum.txt"), kRemedy);
  return clip;
}

}  // namespace edgevo
