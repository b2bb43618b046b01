#pragma once
// What `edgevo bench` is to run: sequences x variants x seeds, from a YAML file such as
// share/bench/rendered.yaml:
//
//   seeds: 1..5                     # or: 1 2 7
//   variants: normal every3 mixed   # of every sequence that names none itself; words joined by + act
//                                   together: every3+glare
//   detectors: canny edge_drawing   # every variant by each of these; left out: as the parameters say
//   set:                            # every variant as it is, and once more with each of these
//     few_points: mapping.window.max_points=500
//     no_corners: mapping.corners.max_inlier_share=0 mapping.window.adjust_corners=false
//   sequences:
//     street:                       # a name for tables and folders
//       source: scene:street        # a scene of the simulator, or any SOURCE of `edgevo run`
//       frames: 0:200               # this and all below may be left out
//       camera: camera.yaml
//       params: published_camera.yaml
//       variants: normal
//
// A variant is made of `normal` (nothing), `everyN` (only each N-th frame), `backward` (the last frame
// first), `gaps` (frames missing here and there, drawn by the seed), the name of a change of light and that
// of a detector of edges: `detectors: canny edge_drawing` makes `normal+canny` and `normal+edge_drawing` of
// `normal`. `precomputed:D` are the edges of detector D, found once for all seeds.
//
// A name below `set` stands for parameters (GROUP.KEY=VALUE, separated by blanks) over those of the sequence.
// It is a word of variants, too: `every3+no_corners`. Where the list has such a word in its variants, it runs
// those that it names and no others.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace edgevo {

/// Begins a source that is rendered: scene:NAME.
constexpr std::string_view kScenePrefix = "scene:";

/// Parameters under a name, over those of a sequence: one line below `set`.
struct BenchSetting {
  /// A word of variants.
  std::string name;
  /// GROUP.KEY=VALUE each.
  std::vector<std::string> assignments;
  /// "LIST:LINE", for messages.
  std::string where;
};

/// How a sequence is changed before it is run, and with which parameters it is.
struct BenchVariant {
  std::string name = "normal";  ///< as the list gives it
  int every = 1;                ///< only each every-th frame
  bool backward = false;        ///< the last frame first
  bool gaps = false;            ///< frames are missing here and there
  std::string light;            ///< kind of `edgevo relight`; empty: as it is
  std::string detector;         ///< of edges; empty: as the parameters say
  /// Applied in this order, over the parameters of the sequence.
  std::vector<BenchSetting> settings;
};

/// A sequence of the list.
struct BenchSequence {
  std::string name;                    ///< for tables and folders
  std::string source;                  ///< SOURCE of `edgevo run`, or scene:NAME
  std::string frames;                  ///< as the list has it; may be empty, as the two that follow
  std::string camera;                  ///< a file beside the list
  std::string params;                  ///< a file beside the list
  std::vector<BenchVariant> variants;  ///< each is run with every seed
  std::string where;                   ///< "LIST:LINE" of its source, for messages
};

/// All that a benchmark runs.
struct BenchList {
  std::vector<uint64_t> seeds;           ///< of every sequence and variant
  std::vector<BenchSequence> sequences;  ///< in the order of the file

  /// Runs that the list asks for: variants of all sequences times seeds.
  int jobs() const;
};

/// Strict: unknown keys, seeds and variants, a sequence without a source, a name or seed given twice and a
/// list without sequences are InputErrors "WHERE:LINE: ...". `lights` are the known changes of light,
/// `detectors` those of edges.
BenchList parse_bench_list(const std::string& text, const std::string& where,
                           const std::vector<std::string>& lights,
                           const std::vector<std::string>& detectors = {});

/// The list as a file that parse_bench_list reads as the same list, lines (`where`) aside.
std::string bench_list_yaml(const BenchList& list);

/// "1..5" or "1 2 7". Throws InputError opened by `where`.
std::vector<uint64_t> parse_seeds(const std::string& text, const std::string& where);

}  // namespace edgevo
