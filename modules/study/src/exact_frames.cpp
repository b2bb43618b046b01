// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/study/exact_frames.h"

#include "edgevo/core/error.h"
#include "edgevo/core/frame_checks.h"
#include "edgevo/datasets/virtual_kitti.h"
#include "edgevo/mrpt_bridge/image_file.h"
#include "edgevo/simulation/scene_renderer.h"

namespace edgevo {
namespace {

class RenderedFrames : public ExactFrames {
 public:
  explicit RenderedFrames(Scene scene) : renderer_(std::move(scene)) {}

  const Camera& camera() const override { return renderer_.camera(); }
  int size() const override { return renderer_.size(); }
  std::string name() const override { return "rendered scene " + renderer_.scene().name; }
  SE3 T_world_cam(int index) const override { return renderer_.T_world_cam(index); }
  ExactFrame load(int index) const override {
    RenderedFrame frame = renderer_.render(index);
    return {index, frame.time.seconds(), std::move(frame.image), std::move(frame.depth), frame.T_world_cam};
  }

 private:
  SceneRenderer renderer_;
};

class VirtualKittiFrames : public ExactFrames {
 public:
  explicit VirtualKittiFrames(VirtualKitti sequence) : sequence_(std::move(sequence)) {}

  const Camera& camera() const override { return sequence_.camera; }
  int size() const override { return int(sequence_.images.size()); }
  std::string name() const override { return "Virtual KITTI " + sequence_.release; }
  SE3 T_world_cam(int index) const override { return sequence_.T_world_cam[size_t(index)]; }
  ExactFrame load(int index) const override {
    const auto i = size_t(index);
    const Pinhole pinhole = sequence_.camera.pinhole();
    ExactFrame frame{index,
                     seconds_between(sequence_.times.front(), sequence_.times[i]),
                     read_gray_image(sequence_.images[i]),
                     {},
                     sequence_.T_world_cam[i]};
    check_image_size(frame.image, pinhole, sequence_.images[i]);
    frame.depth = read_virtual_kitti_depth(sequence_.depths[i], pinhole.width, pinhole.height);
    return frame;
  }

 private:
  VirtualKitti sequence_;
};

}  // namespace

std::unique_ptr<ExactFrames> rendered_frames(const std::string& name) {
  Scene scene = load_scene(name);
  if (scene.shutter.rolling_s > 0)
    throw InputError("scene " + scene.name,
                     "with a rolling shutter, depth and pose are not those of all rows",
                     "take a scene without one");
  return std::make_unique<RenderedFrames>(std::move(scene));
}

std::unique_ptr<ExactFrames> virtual_kitti_frames(const SourceOptions& options) {
  if (!is_virtual_kitti(options.path))
    throw InputError(options.path, "is not a folder of a Virtual KITTI sequence",
                     "name one as vkitti_1.3.1_rgb/0001/clone or Scene01/clone");
  VirtualKitti sequence = read_virtual_kitti(options);
  if (sequence.T_world_cam.empty())
    throw InputError(options.path, "its camera poses are missing",
                     sequence.release == "1.3.1" ? "unpack vkitti_1.3.1_extrinsicsgt next to it"
                                                 : "unpack extrinsic.txt into it");
  return std::make_unique<VirtualKittiFrames>(std::move(sequence));
}

}  // namespace edgevo
