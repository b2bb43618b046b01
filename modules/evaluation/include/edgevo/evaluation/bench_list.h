#pragma once
// What `edgevo bench` is to run: sequences x variants x seeds, from a YAML file such as share/bench/rendered.yaml:
//
//   seeds: 1..5                     # or: 1 2 7
//   variants: normal every3 mixed   # of every sequence that names none itself; words joined by + act together: every3+glare
//   sequences:
//     street:                       # a name for tables and folders
//       source: scene:street        # a scene of the simulator, or any SOURCE of `edgevo run`
//       frames: 0:200               # this and all below may be left out
//       camera: camera.yaml
//       params: published_camera.yaml
//       variants: normal
//
// A variant is made of `normal` (nothing), `everyN` (only each N-th frame), `backward` (the last frame first), `gaps` (frames missing here
// and there, drawn by the seed) and the name of a change of light.
#include <cstdint>
#include <string>
#include <vector>

namespace edgevo {

/// How a sequence is changed before it is run.
struct BenchVariant {
  std::string name = "normal";  ///< as the list gives it
  int every = 1;  ///< only each every-th frame
  bool backward = false;  ///< the last frame first
  bool gaps = false;  ///< frames are missing here and there
  std::string light;  ///< kind of `edgevo relight`; empty: as it is
};

/// A sequence of the list.
struct BenchSequence {
  std::string name, source, frames, camera, params;  ///< texts as in the list; all but the first two may be empty
  std::vector<BenchVariant> variants;  ///< each is run with every seed
  std::string where;  ///< "LIST:LINE" of its source, for messages
};

/// All that a benchmark runs.
struct BenchList {
  std::vector<uint64_t> seeds;  ///< of every sequence and variant
  std::vector<BenchSequence> sequences;  ///< in the order of the file

  /// Runs that the list asks for: variants of all sequences times seeds.
  int jobs() const;
};

/// Strict: unknown keys, seeds and variants, a sequence without a source, a name or seed given twice and a list without sequences are
/// InputErrors "WHERE:LINE: ...". `lights` are the known changes of light.
BenchList parse_bench_list(const std::string& text, const std::string& where, const std::vector<std::string>& lights);

}  // namespace edgevo
