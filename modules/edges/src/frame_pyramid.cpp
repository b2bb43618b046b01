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
  EdgeParams params;
  std::unique_ptr<EdgeDetector> detector;
  std::optional<Undistortion> undistortion;  // none where the camera has no distortion

  void make_maps() {
    undistortion.reset();
    if (camera.has_distortion() && camera.pinhole.width > 1 && camera.pinhole.height > 1)
      undistortion.emplace(make_undistortion_maps(camera));
  }

  Plane<uint8_t> undistort(const GrayImage& image) const {
    Plane<uint8_t> out(image.width, image.height);
    if (undistortion)
      undistortion->apply(image.view(), &out);
    else
      std::copy(image.pixels.begin(), image.pixels.end(), out.row(0));
    return out;
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
double PyramidBuilder::residual_k1() const { return impl_->camera.residual_k1; }

void PyramidBuilder::set_residual_k1(double k1) {
  if (k1 == impl_->camera.residual_k1) return;
  impl_->camera.residual_k1 = k1;
  impl_->make_maps();
}

std::shared_ptr<const FramePyramid> PyramidBuilder::build(const GrayImage& image) {
  const Pinhole& camera = impl_->camera.pinhole;
  if (image.width != camera.width || image.height != camera.height)
    throw InputError("image", "is " + std::to_string(image.width) + "x" + std::to_string(image.height) +
                                  " but the camera is " + std::to_string(camera.width) + "x" +
                                  std::to_string(camera.height), "give the camera file of these images");
  auto pyramid = std::make_shared<FramePyramid>();
  pyramid->source = image;
  pyramid->residual_k1 = impl_->camera.residual_k1;
  pyramid->levels.resize(impl_->params.levels);
  for (int l = 0; l < impl_->params.levels; ++l) {
    PyramidLevel& level = pyramid->levels[l];
    level.pinhole = camera.at_level(l);
    if (l == 0) {
      level.gray = impl_->undistort(image);
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
