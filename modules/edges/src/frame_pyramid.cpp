#include "edgevo/edges/frame_pyramid.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "edgevo/core/error.h"
#include "edgevo/edges/edge_extraction.h"
#include "opencv_view.h"
#include "undistortion.h"

namespace edgevo {

struct PyramidBuilder::Impl {
  Camera camera;
  double readout_s = 0;
  EdgeParams params;
  std::unique_ptr<EdgeDetector> detector;
  std::optional<Undistortion> undistortion;  // none where the camera has no distortion
  std::optional<ShiftedUndistortion> rolling;  // made for the first image of a rolling shutter

  bool has_area() const { return camera.pinhole.width > 1 && camera.pinhole.height > 1; }

  void make_maps() {
    undistortion.reset();
    rolling.reset();
    if (camera.has_distortion() && has_area()) undistortion.emplace(make_undistortion_maps(camera));
  }

  Plane<uint8_t> undistort(const GrayImage& image, const ImageMotion& motion) {
    Plane<uint8_t> out(image.width, image.height);
    if (readout_s != 0 && motion.is_known() && has_area()) {
      if (!rolling) rolling.emplace(make_undistortion_maps(camera));
      rolling->apply(rolling_shift(motion), image.view(), &out);
    } else if (undistortion) {
      undistortion->apply(image.view(), &out);
    } else {
      std::copy(image.pixels.begin(), image.pixels.end(), out.row(0));
    }
    return out;
  }

  // How far the rolling shutter moves the points of the undistorted image in the raw one, at the nodes of a grid.
  ShiftGrid rolling_shift(const ImageMotion& motion) const {
    const Pinhole& p = camera.pinhole;
    ShiftGrid grid(p.width, p.height);
    for (int row = 0; row < grid.rows(); ++row)
      for (int column = 0; column < grid.columns(); ++column) {
        const Eigen::Vector2d x = p.ray({double(column * ShiftGrid::kCell), double(row * ShiftGrid::kCell)}).head<2>();
        const Eigen::Vector2d moved = camera.distort(add_rolling(p, readout_s, motion, x)) - camera.distort(x);
        grid.set(column, row, float(p.fx * moved.x()), float(p.fy * moved.y()));
      }
    return grid;
  }

  void find_edges(PyramidLevel* level) const {
    Gradient gradient = compute_gradient(level->gray.view());
    const Plane<uint8_t> mask = detector->detect(level->gray.view(), gradient);
    level->edges = extract_edges(mask, gradient, params.min_chain);
    level->field = NearestField(level->edges, params.field_radius);
    level->gradient_magnitude = std::move(gradient.magnitude);
  }
};

PyramidBuilder::PyramidBuilder(const Camera& camera, const EdgeParams& params) : impl_(new Impl) {
  camera.check("camera");
  impl_->camera = camera;
  impl_->params = params;
  impl_->detector = make_edge_detector(params);
  impl_->make_maps();
}
PyramidBuilder::~PyramidBuilder() = default;
PyramidBuilder::PyramidBuilder(PyramidBuilder&&) noexcept = default;

const Pinhole& PyramidBuilder::pinhole() const { return impl_->camera.pinhole; }
ImageCorrection PyramidBuilder::correction() const { return {impl_->camera.residual_k1, impl_->readout_s}; }

void PyramidBuilder::set_correction(const ImageCorrection& correction) {
  impl_->readout_s = correction.readout_s;
  if (correction.k1 == impl_->camera.residual_k1) return;
  impl_->camera.residual_k1 = correction.k1;
  impl_->make_maps();
}

std::shared_ptr<const FramePyramid> PyramidBuilder::build(const GrayImage& image, const ImageMotion& motion) {
  const Pinhole& camera = impl_->camera.pinhole;
  if (image.width != camera.width || image.height != camera.height)
    throw InputError("image", "is " + std::to_string(image.width) + "x" + std::to_string(image.height) +
                                  " but the camera is " + std::to_string(camera.width) + "x" +
                                  std::to_string(camera.height), "give the camera file of these images");
  auto pyramid = std::make_shared<FramePyramid>();
  pyramid->source = image;
  pyramid->correction = correction();
  pyramid->levels.resize(impl_->params.levels);
  for (int l = 0; l < impl_->params.levels; ++l) {
    PyramidLevel& level = pyramid->levels[l];
    level.pinhole = camera.at_level(l);
    if (l == 0) {
      level.gray = impl_->undistort(image, motion);
    } else {
      level.gray = Plane<uint8_t>(level.pinhole.width, level.pinhole.height);
      cv::Mat to = as_mat(level.gray);
      cv::pyrDown(as_mat(pyramid->levels[l - 1].gray), to, to.size());
    }
    if (l < impl_->params.edge_levels) impl_->find_edges(&level);
  }
  return pyramid;
}

}  // namespace edgevo
