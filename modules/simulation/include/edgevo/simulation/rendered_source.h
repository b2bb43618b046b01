// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Rendered frames as an image source, which feeds the odometry without files.
#include <memory>

#include "edgevo/core/image_source.h"
#include "edgevo/simulation/scene_renderer.h"

namespace edgevo {

/// Renders each frame on demand.
class RenderedSource : public ImageSource {
 public:
  /// Frames begin <= index < end of the scene; end -1: to its last. Frame::index counts from the scene's
  /// first frame. Throws InputError if the range has no frame.
  explicit RenderedSource(std::shared_ptr<const SceneRenderer> renderer, int begin = 0, int end = -1);

  const Camera& camera() const override { return renderer_->camera(); }
  std::optional<SE3> T_vehicle_cam() const override {
    const std::optional<CameraMount>& mount = renderer_->scene().mount;
    return mount ? std::make_optional(edgevo::T_vehicle_cam(*mount)) : std::nullopt;
  }
  std::optional<int> size() const override { return end_ - begin_; }
  std::string kind() const override { return "rendered scene " + renderer_->scene().name; }
  std::vector<std::pair<std::string, std::string>> details() const override;
  std::vector<Timestamp> times() const override;
  std::optional<Frame> next() override;
  bool skip() override;

  /// Renderer of the frames.
  const SceneRenderer& renderer() const { return *renderer_; }

 private:
  std::shared_ptr<const SceneRenderer> renderer_;
  int begin_, end_, next_;
};

}  // namespace edgevo
