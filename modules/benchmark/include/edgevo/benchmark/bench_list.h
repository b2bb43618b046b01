// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Input of `edgevo bench`: sequences x variants x seeds, from a YAML file such as share/bench/rendered.yaml:
//
//   seeds: 1..5                     # or: 1 2 7
//   variants: normal every3 mixed   # default for all sequences; words joined by + are combined:
//                                   # every3+glare
//   scene_seed: 7                   # of all scenes, or `days_since YYYY-MM-DD`; default: that of each
//   detectors: canny edge_drawing   # every variant with each of these; default: the parameter
//   set:                            # every variant without and with each of these
//     few_points: mapping.window.max_points=500
//     no_corners: mapping.corners.max_inlier_share=0 mapping.window.adjust_corners=false
//   sequences:
//     street:                       # name in tables and folders
//       source: scene:street        # a scene of the simulator, or any SOURCE of `edgevo run`
//       frames: 0:200               # optional, as everything below
//       camera: camera.yaml
//       params: published_camera.yaml
//       variants: normal
//
// A variant is made of `normal` (nothing), `everyN` (only each N-th frame), `backward` (the last frame
// first), `gaps` (random frames missing, by the seed), the name of a change of light and that of an edge
// detector: `detectors: canny edge_drawing` makes `normal+canny` and `normal+edge_drawing` of
// `normal`. `precomputed:D` computes the edges of detector D once for all seeds.
//
// A name below `set` means parameters (GROUP.KEY=VALUE, separated by blanks) that override those of the
// sequence. It can also be used as a word of a variant: `every3+no_corners`. If a variant of the list does
// so, the list runs the variants that it names and no others.
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace edgevo {

/// Begins a source that is rendered: scene:NAME.
constexpr std::string_view kScenePrefix = "scene:";
/// Begins a detector whose probabilities are computed once, before its runs: precomputed:NAME.
constexpr std::string_view kPrecomputedPrefix = "precomputed:";

/// Named parameters that override those of a sequence: one line below `set`.
struct BenchSetting {
  /// Name, usable as a word of a variant.
  std::string name;
  /// Assignments GROUP.KEY=VALUE.
  std::vector<std::string> assignments;
  /// Location "LIST:LINE", for messages.
  std::string where;
};

/// Changes of a sequence before it is run, and the parameters of the run.
struct BenchVariant {
  /// Name in the list.
  std::string name = "normal";
  /// Step between the frames used.
  int every = 1;
  /// Whether the frames are played in reverse.
  bool backward = false;
  /// Whether random frames are missing.
  bool gaps = false;
  /// Kind of `edgevo relight`; empty: unchanged light.
  std::string light;
  /// Edge detector; empty: that of the parameters.
  std::string detector;
  /// Settings, applied in this order over the parameters of the sequence.
  std::vector<BenchSetting> settings;
};

/// A sequence of the list.
struct BenchSequence {
  /// Name in tables and folders.
  std::string name;
  /// Source: SOURCE of `edgevo run`, or scene:NAME.
  std::string source;
  /// Range of frames as in the list; may be empty.
  std::string frames;
  /// Camera file, relative to the list; may be empty.
  std::string camera;
  /// Parameter file, relative to the list; may be empty.
  std::string params;
  /// Variants, each run with every seed.
  std::vector<BenchVariant> variants;
  /// Location "LIST:LINE" of its source, for messages.
  std::string where;
  /// Seed of the scene; nullopt: that of its file, or there is no scene.
  std::optional<uint64_t> scene_seed;

  /// Whether the source is a scene to be rendered.
  bool is_rendered() const { return source.rfind(kScenePrefix, 0) == 0; }
};

/// Contents of a benchmark list.
struct BenchList {
  /// Seeds for every sequence and variant.
  std::vector<uint64_t> seeds;
  /// Sequences in the order of the file.
  std::vector<BenchSequence> sequences;
  /// Seed of all scenes; nullopt: those of their files.
  std::optional<uint64_t> scene_seed;

  /// Number of runs of the list: variants of all sequences times seeds.
  int jobs() const;
};

/// Strict parser: unknown keys and variants, invalid seeds, a sequence without a source, a name or seed given
/// twice and a list without sequences are InputErrors "WHERE:LINE: ...". `lights` are the known changes of
/// light, `detectors` the known edge detectors; at `now` the seed of the scenes is determined.
BenchList parse_bench_list(const std::string& text, const std::string& where,
                           const std::vector<std::string>& lights,
                           const std::vector<std::string>& detectors = {},
                           std::chrono::system_clock::time_point now = std::chrono::system_clock::now());

/// Replaces the seed of all scenes of the list. Throws InputError prefixed with `where` if it has no scene.
void set_scene_seed(uint64_t seed, const std::string& where, BenchList* list);

/// Seed of scenes from its text: a number, or "days_since YYYY-MM-DD", the number of days from that date to
/// the date of `now`, both UTC. So nobody chooses the scenes of a day. Throws InputError prefixed with
/// `where`, also for a date after `now`.
uint64_t parse_scene_seed(const std::string& text, const std::string& where,
                          std::chrono::system_clock::time_point now);

/// The list as YAML that parse_bench_list() turns back into the same list, except for the locations
/// (`where`); the seed of the scenes is written as the number that it is.
std::string bench_list_yaml(const BenchList& list);

/// Parses seeds: "1..5" or "1 2 7". Throws InputError prefixed with `where`.
std::vector<uint64_t> parse_seeds(const std::string& text, const std::string& where);

}  // namespace edgevo
