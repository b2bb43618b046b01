// SPDX-License-Identifier: BSD-3-Clause
// Records over rendered sequences what the trust is given, for recorded_evidence_test.cpp, in two minutes:
//
//   cmake --build build/release --target record_evidence
//
// For a new measurement among the columns. After a change of weights or doubts the evidence stays, and the
// test itself writes what comes out. `edgevo_record_evidence FOLDER NAME...` records some sequences only.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "edgevo/alignment/reference.h"
#include "edgevo/core/output_file.h"
#include "edgevo/odometry/odometry.h"
#include "edgevo/simulation/relight.h"
#include "edgevo/simulation/scene_renderer.h"
#include "unit/confidence/recorded_evidence.h"

namespace edgevo::test {
namespace {

struct Sequence {
  const char* name;
  const char* scene;
  int begin, every, frames;
  const char* light;  // simulation/relight.h; empty: none
  double focal;       // focal length in the camera file over the true one
};
// Hard enough for doubts: images left away, bad light, camera files with a wrong focal length. Each ends
// before a second segment: from outside it is not seen whether a frame that begins one was followed before.
constexpr Sequence kSequences[] = {
    {"street", "street", 100, 4, 65, "", 1},
    {"corridor", "corridor", 0, 3, 80, "jumps", 1},
    {"desk", "desk", 0, 4, 70, "blur", 1},
    {"rotation", "rotation", 90, 1, 110, "", 1.2},
    {"office_walk", "office_walk", 0, 1, 100, "", 0.8},
    {"open_land", "open_land", 0, 3, 100, "mixed", 1},
    {"turn_in_place", "rotation", 0, 3, 95, "noise", 1},
};

// Follows a run from outside, as the odometry follows it itself.
class Recorder {
 public:
  explicit Recorder(const Camera& camera) : odometry_(camera, OdometryParams(), OdometryOptions()) {}

  void add(const Frame& frame) {
    RecordedFrame next;
    const FrameRecord record = odometry_.process(frame);
    const NewestPose& pose = odometry_.newest_pose();
    next.has_pose = std::isfinite(record.p_right) && pose.T_cam_map;
    if (next.has_pose) {
      next.segment = pose.segment;
      next.evidence = record.evidence;
      next.evidence.pose_sigmas.fill(record.evidence.pose_sigmas.back());
      const SE3 T_map_cam = pose.T_cam_map->inverse();
      next.motion = (T_map_before_.inverse() * T_map_cam).log();
      T_map_before_ = T_map_cam;
    }
    check(next, record);
    const RecordedFrame kept = rounded(next);
    rows_.push_back({kept, replay_.add(kept)});
  }
  const std::vector<EvidenceRow>& rows() const { return rows_; }
  int other_frames() const { return others_; }

 private:
  // Before rounding, the replay is the run.
  void check(const RecordedFrame& frame, const FrameRecord& record) {
    const std::optional<Outcome> exact = exact_.add(frame);
    if (exact && std::abs(exact->p_right - record.p_right) > 1e-6) {
      ++others_;
      std::fprintf(stderr, "frame %d: p_right %.6f in the run, %.6f in the replay\n", record.index,
                   record.p_right, exact->p_right);
    }
  }

  Odometry odometry_;
  EvidenceReplay exact_, replay_;
  SE3 T_map_before_;
  int others_ = 0;
  std::vector<EvidenceRow> rows_;
};

bool record(const Sequence& s, const std::string& folder) {
  const SceneRenderer renderer(load_scene(s.scene));
  Camera camera = renderer.camera();
  Pinhole pinhole = camera.pinhole();
  pinhole.fx *= s.focal, pinhole.fy *= s.focal;
  camera.set_pinhole(pinhole);
  Recorder recorder(camera);
  for (int k = 0; k < s.frames && s.begin + s.every * k < renderer.size(); ++k) {
    GrayImage image = renderer.render_image(s.begin + s.every * k);
    const double seconds = k / 10.0;
    if (*s.light) image = Relight(s.light, 1).apply(image, k, seconds);
    recorder.add({k, Timestamp::from_seconds(seconds), std::move(image), {}});
  }
  OutputFile file(folder + "/" + s.name + ".csv");
  file.write(to_text(recorder.rows()));
  file.close();
  std::printf("%s: %zu frames\n", s.name, recorder.rows().size());
  return recorder.other_frames() == 0;
}

}  // namespace
}  // namespace edgevo::test

int main(int count, char** arguments) {
  using namespace edgevo::test;
  try {
    bool are_right = count > 1;
    for (const Sequence& sequence : kSequences) {
      bool is_wanted = count == 2;
      for (int i = 2; i < count; ++i) is_wanted |= std::string(arguments[i]) == sequence.name;
      if (is_wanted) are_right &= record(sequence, arguments[1]);
    }
    return are_right ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return EXIT_FAILURE;
  }
}
