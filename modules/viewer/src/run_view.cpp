// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/viewer/run_view.h"

#include <mrpt/gui/CDisplayWindow3D.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <algorithm>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <thread>

#include "display.h"
#include "view_image.h"
#include "view_map.h"

namespace edgevo {
namespace {

constexpr int kWidth = 1100, kHeight = 900;
constexpr double kLargestImageShare = 0.55;  // share of the height of the window
constexpr const char* kImageViewport = "image";
constexpr const char* kHelp = "space pause   s step   c colour   f follow   q quit";

}  // namespace

struct RunView::Impl {
  Impl(const std::optional<SE3>& T_vehicle_cam, std::shared_ptr<MapLog> log)
      : window("edgevo", kWidth, kHeight) {
    mrpt::opengl::COpenGLScene::Ptr& scene = window.get3DSceneAndLock();
    scene->createViewport(kImageViewport);
    const auto main = scene->getViewport();
    main->setCustomBackgroundColor({0.08f, 0.09f, 0.1f});
    map.emplace(T_vehicle_cam, std::move(log), main.get());
    window.unlockAccess3DScene();
    window.setCameraElevationDeg(35);
    window.setCameraAzimuthDeg(200);  // from behind: x is forward at the first image
  }

  void draw(const ProcessedFrame& processed) {
    const FrameView view = processed.view();
    if (!view.pyramid) return;
    mrpt::img::CImage picture(draw_frame(view, colour), mrpt::img::DEEP_COPY);
    const double share = std::min(kLargestImageShare, double(kWidth) / kHeight * double(picture.getHeight()) /
                                                          double(picture.getWidth()));
    mrpt::opengl::COpenGLScene::Ptr& scene = window.get3DSceneAndLock();
    map->update(processed.record, view);
    const auto image = scene->getViewport(kImageViewport);
    image->setViewportPosition(0, 0, 1, share);
    image->setImageView(std::move(picture));
    scene->getViewport()->setViewportPosition(0, share, 1, 1 - share);
    window.addTextMessage(8, -20, describe(processed.record), 0);
    window.addTextMessage(8, 8, kHelp, 1);
    window.unlockAccess3DScene();
    if (follow) follow_camera();
    window.setWindowTitle("edgevo: " + describe(processed.record) + (paused ? " (paused)" : ""));
    window.forceRepaint();
  }

  std::string describe(const FrameRecord& record) const {
    return "frame " + std::to_string(record.index) + " " + std::string(to_string(record.state)) +
           (colour == PointColour::kDepth ? ", colour: depth" : ", colour: residual");
  }

  void follow_camera() {
    if (!map->camera() || map->median_depth() <= 0) return;
    const Eigen::Vector3d& c = *map->camera();
    window.setCameraPointingToPoint(float(c.x()), float(c.y()), float(c.z()));
    if (!zoomed) window.setCameraZoom(float(2.5 * map->median_depth()));
    zoomed = true;
  }

  /// Handles pressed keys. Returns whether to draw again.
  bool take_keys() {
    bool changed = false;
    while (window.isOpen() && window.keyHit()) {
      const int key = window.getPushedKey();
      if (key == ' ') paused = !paused;
      if (key == 's' || key == 'S') paused = step = true;
      if (key == 'c' || key == 'C')
        colour = colour == PointColour::kDepth ? PointColour::kResidual : PointColour::kDepth;
      if (key == 'f' || key == 'F') follow = !follow;
      if (key == 'q' || key == 'Q') end = true;
      changed = true;
    }
    return changed;
  }

  mrpt::gui::CDisplayWindow3D window;
  std::optional<ViewMap> map;
  PointColour colour = PointColour::kDepth;
  bool paused = false, step = false, follow = true, zoomed = false, end = false;
};

std::unique_ptr<RunView> RunView::open(const std::optional<SE3>& T_vehicle_cam, std::shared_ptr<MapLog> log,
                                       std::string* why) {
  if (!has_display()) {
    const char* name = std::getenv("DISPLAY");
    *why = name ? std::string("the display ") + name + " does not answer"
                : "there is no display (DISPLAY is not set)";
    return nullptr;
  }
  auto impl = std::make_unique<Impl>(T_vehicle_cam, std::move(log));
  if (!impl->window.isOpen()) {
    *why = "the window does not open";
    return nullptr;
  }
  return std::unique_ptr<RunView>(new RunView(std::move(impl)));
}

RunView::RunView(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RunView::~RunView() = default;

bool RunView::show(const ProcessedFrame& processed, const std::function<bool()>& stop) {
  if (!impl_->window.isOpen()) {
    impl_->map.reset();  // nobody reads its events any more, and the log would keep them
    return true;
  }
  impl_->step = false;
  impl_->take_keys();
  impl_->draw(processed);
  while (impl_->paused && !impl_->step && !impl_->end && impl_->window.isOpen() && !stop()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (impl_->take_keys()) impl_->draw(processed);
  }
  return !impl_->end;
}

}  // namespace edgevo
