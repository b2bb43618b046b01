#include "rendered_clips.h"

#include <algorithm>

#include "drive.h"
#include "edgevo/simulation/rendered_source.h"

namespace edgevo::test {

RenderedDrive render_drive(const Scene& scene, int begin, int end) {
  const auto renderer = std::make_shared<SceneRenderer>(scene);
  RenderedSource source(renderer, begin, end);
  return {read_clip(source, [](int) { return true; }), truth_of(renderer->scene(), begin, end)};
}

RenderedDrive part_of(const RenderedDrive& drive, int begin, int end) {
  auto clip = std::make_shared<Clip>(Clip{drive.clip->camera, drive.clip->kind, {}});
  clip->frames.assign(drive.clip->frames.begin() + begin, drive.clip->frames.begin() + end);
  Trajectory truth;
  truth.path = drive.truth.path;
  truth.poses.assign(drive.truth.poses.begin() + begin, drive.truth.poses.begin() + end);
  return {clip, truth};
}

RenderedDrive backward(const RenderedDrive& drive) {
  RenderedDrive mirrored{played_backward(*drive.clip), drive.truth};
  std::reverse(mirrored.truth.poses.begin(), mirrored.truth.poses.end());
  for (size_t i = 0; i < mirrored.truth.poses.size(); ++i)
    mirrored.truth.poses[i].time = mirrored.clip->frames[i].time;
  return mirrored;
}

const RenderedDrive& street_drive() {
  static const RenderedDrive drive = render_drive(load_scene("street"), 0, 130);
  return drive;
}

const RenderedDrive& desk_drive() {
  static const RenderedDrive drive = render_drive(load_scene("desk"), 0, 100);
  return drive;
}

const RenderedDrive& corridor_drive() {
  static const RenderedDrive drive = render_drive(load_scene("corridor"), 0, 200);
  return drive;
}

}  // namespace edgevo::test
