#pragma once
// Rendered frames as an image source, so that the odometry can be fed without a file.
#include <memory>

#include "edgevo/core/image_source.h"
#include "edgevo/simulation/scene_renderer.h"

namespace edgevo {

/// Renders each frame when it is wanted.
class RenderedSource : public ImageSource {
 public:
  /// Frames begin <= index < end of the scene; end -1: to its last. Frame::index counts from the scene's first frame.
  /// Throws InputError when that range holds no frame.
  explicit RenderedSource(std::shared_ptr<const SceneRenderer> renderer, int begin = 0, int end = -1);

  const Camera& camera() const override { return renderer_->camera(); }
  std::optional<int> size() const override { return end_ - begin_; }
  std::string kind() const override { return "rendered scene " + renderer_->scene().name; }
  std::vector<std::pair<std::string, std::string>> details() const override;
  std::vector<Timestamp> times() const override;
  std::optional<Frame> next() override;
  bool skip() override;

  const SceneRenderer& renderer() const { return *renderer_; }  ///< that renders the frames

 private:
  std::shared_ptr<const SceneRenderer> renderer_;
  int begin_, end_, next_;
};

}  // namespace edgevo
