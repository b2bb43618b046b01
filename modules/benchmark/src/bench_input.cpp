// SPDX-License-Identifier: BSD-3-Clause
#include "bench_input.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "edgevo/core/block_yaml.h"
#include "edgevo/core/error.h"
#include "edgevo/datasets/camera_file.h"
#include "edgevo/datasets/ground_truth.h"
#include "edgevo/datasets/source_folder.h"
#include "edgevo/datasets/subsample.h"
#include "edgevo/files/output_folder.h"
#include "edgevo/simulation/folder_export.h"
#include "edgevo/simulation/relit_source.h"
#include "edgevo/simulation/rendered_source.h"
#include "kept_clip.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

// `path` itself if it is absolute, else below `folder`.
std::string below(const fs::path& folder, const std::string& path) {
  return path.empty() ? "" : (folder / path).lexically_normal().string();
}

// "lakeshore" of "lakeshore:winter".
std::string without_season(const std::string& scene) { return scene.substr(0, scene.rfind(':')); }

bool is_scene_name(const std::string& name) {
  const std::vector<std::string> names = scene_names();
  return std::find(names.begin(), names.end(), without_season(name)) != names.end();
}

bool is_there(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

// Prefixes errors with the line of the list that caused them.
template <class Read>
void at(const std::string& where, Read&& read) {
  try {
    read();
  } catch (const InputError& e) {
    throw InputError(where, e.what(), "");
  }
}

std::string indented(const std::string& text) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) result += "  " + line + '\n';
  return result;
}

}  // namespace

BenchInput::BenchInput(const BenchSequence& sequence, const std::string& data, const std::string& list)
    : sequence_(sequence) {
  const fs::path list_folder = fs::path(list).parent_path();
  const std::string& where = sequence.where;
  const bool rendered = sequence.is_rendered();
  if (rendered) scene_ = sequence.source.substr(kScenePrefix.size());
  if (rendered && !is_scene_name(scene_)) scene_ = below(list_folder, scene_);
  at(where, [&] { source_.path = rendered ? "" : source_folder(below(data, sequence.source)); });
  source_.camera_file = below(list_folder, sequence.camera);
  if (rendered ? !is_scene_name(scene_) && !is_there(scene_) && !is_there(without_season(scene_))
               : !is_there(source_.path))
    throw InputError(where, "there is no " + (rendered ? "scene '" + scene_ : "'" + source_.path) + "'",
                     rendered ? "name one that ships with the program or a YAML file"
                              : "give the folder of the data with --data DIR");
  at(where, [&] {
    if (!sequence.frames.empty()) set_frame_range(sequence.frames, &source_);
    if (!source_.camera_file.empty()) camera_text_ = camera_yaml(read_camera_file(source_.camera_file), "");
    if (!sequence.params.empty())
      read_params_file(below(list_folder, sequence.params), [&](ParamVisitor& v) { params_.visit(v); });
  });
  if (rendered && !camera_text_.empty())
    throw InputError(where, "a scene has its own camera", "remove `camera`");
  for (const BenchVariant& variant : sequence.variants) (void)with_settings(variant);
}

void BenchInput::check_output(const std::string& out) const {
  if (scene_.empty()) check_apart(source_.path, out);
}

std::string BenchInput::scene_key() const {
  if (scene_.empty()) return "";
  const std::optional<uint64_t>& seed = sequence_.scene_seed;
  return scene_ + " " + sequence_.frames + (seed ? " seed " + std::to_string(*seed) : "");
}

std::shared_ptr<const SceneRenderer> BenchInput::renderer() const {
  return std::make_shared<const SceneRenderer>(load_scene(scene_, sequence_.scene_seed));
}

void BenchInput::render_to(const std::string& folder, int threads) {
  const std::shared_ptr<const SceneRenderer> all = renderer();
  const RenderedSource rendered(all, source_.first, source_.last.value_or(-1));
  keep_clip(*all, source_.first, source_.first + *rendered.size(), rendered.kind(), threads, folder);
}

void BenchInput::render(const BenchHost& host) {
  const std::shared_ptr<const SceneRenderer> all = renderer();
  RenderedSource rendered(all, source_.first, source_.last.value_or(-1));
  const int begin = source_.first, end = begin + *rendered.size();
  scene_truth_ = ground_truth_tum(*all, begin, end);
  const ProgressLine progress = host.progress("rendering " + sequence_.name, rendered.size());
  clip_ = read_clip(rendered, [&](int done) {
    progress(done);
    return !host.stop();
  });
}

std::unique_ptr<ImageSource> BenchInput::open_scene(const BenchHost& host) {
  if (!clip_ && is_kept_clip(kept_scene_)) clip_ = read_kept_clip(kept_scene_, &scene_truth_);
  if (!clip_) render(host);
  return std::make_unique<ClipSource>(clip_);
}

// Frames of `source` (and their ground truth) in reverse, or with some of them missing.
std::unique_ptr<ImageSource> BenchInput::edited(ImageSource& source, const BenchVariant& variant,
                                                uint64_t seed, const BenchHost& host) {
  std::shared_ptr<const Clip> clip = read_clip(source, [&](int) { return !host.stop(); });
  if (clip->frames.empty()) throw InputError(sequence_.where, "there is no frame", "choose more frames");
  if (variant.backward) {
    if (!ground_truth_.empty())
      ground_truth_ = played_backward(ground_truth_, clip->frames.front().time, clip->frames.back().time);
    clip = played_backward(*clip);
  }
  if (variant.gaps) clip = with_gaps(*clip, seed);
  return std::make_unique<ClipSource>(clip);
}

std::unique_ptr<ImageSource> BenchInput::open(const BenchVariant& variant, uint64_t seed,
                                              const BenchHost& host) {
  std::unique_ptr<ImageSource> source;
  if (scene_.empty()) {
    SourceOptions options = source_;
    options.every = variant.every;
    source = open_source(options);
    ground_truth_ = edgevo::ground_truth_tum(options, *source);
  } else {
    SourceOptions thinned;
    thinned.every = variant.every;
    source = subsample(open_scene(host), thinned);
    ground_truth_ = scene_truth_;
  }
  if (variant.backward || variant.gaps) source = edited(*source, variant, seed, host);
  if (variant.light.empty()) return source;
  return std::make_unique<RelitSource>(std::move(source), Relight(variant.light, seed));
}

std::vector<InputDecision> BenchInput::decisions() const {
  return scene_.empty() ? open_source(source_)->decisions() : std::vector<InputDecision>();
}

RunParams BenchInput::with_settings(const BenchVariant& variant) const {
  RunParams params = params_;
  const VisitParams visit = [&](ParamVisitor& v) { params.visit(v); };
  for (const BenchSetting& setting : variant.settings)
    at(setting.where, [&] {
      for (const std::string& assignment : setting.assignments) set_param(assignment, visit);
    });
  return params;
}

RunParams BenchInput::params(const BenchVariant& variant, const std::string& edges) const {
  RunParams params = with_settings(variant);
  if (variant.detector.empty()) return params;
  const VisitParams visit = [&](ParamVisitor& v) { params.visit(v); };
  const bool precomputed = variant.detector.compare(0, kPrecomputedPrefix.size(), kPrecomputedPrefix) == 0;
  set_param("edges.detector=" + (precomputed ? "precomputed" : variant.detector), visit);
  if (precomputed) set_param("edges.folder=" + edges, visit);
  return params;
}

std::string BenchInput::description(const BenchVariant& variant) const {
  const bool is_plain = variant.settings.empty();
  if (is_plain && !description_.empty()) return description_;
  RunParams params = with_settings(variant);
  const auto visit = [&](ParamVisitor& v) { params.visit(v); };
  const std::string camera = camera_text_.empty() ? "" : "camera: |\n" + indented(camera_text_);
  const std::string seed =
      sequence_.scene_seed ? "scene_seed: " + std::to_string(*sequence_.scene_seed) + '\n' : "";
  const std::string text =
      "sequence: " + yaml_scalar(sequence_.name) +
      "\nsource: " + yaml_scalar(scene_.empty() ? source_.path : std::string(kScenePrefix) + scene_) +
      "\nframes: " + yaml_scalar(sequence_.frames) + '\n' + seed + camera + "parameters:\n" +
      write_params(visit, 2);
  if (is_plain) description_ = text;
  return text;
}

}  // namespace edgevo
