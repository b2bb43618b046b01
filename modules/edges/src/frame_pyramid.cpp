// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/frame_pyramid.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "deep_image.h"
#include "edgevo/core/error.h"
#include "edgevo/core/frame_checks.h"
#include "edgevo/core/radial.h"
#include "edgevo/edges/edge_extraction.h"
#include "edgevo/edges/opencv_view.h"
#include "edgevo/files/image_names.h"
#include "halve.h"
#include "undistortion.h"

namespace edgevo {
namespace {

// Radius of the nearest-neighbour fields, pixels: larger than that of any search in them.
constexpr int kFieldRadiusPx = 12;
// Distance of edges to pixels without a source, pixels of their level: that to the border of the image.
constexpr int kBorderPx = 2;

// Clears the pixels of level l that lie in `border`, a mask of level 0.
void clear_masked(const Plane<uint8_t>& border, int l, Plane<uint8_t>* mask) {
  for (int y = 0; y < mask->height(); ++y) {
    const uint8_t* from = border.row(std::min(y << l, border.height() - 1));
    uint8_t* to = mask->row(y);
    for (int x = 0; x < mask->width(); ++x)
      if (from[std::min(x << l, border.width() - 1)]) to[x] = 0;
  }
}

// An image halved to `size`.
Plane<uint8_t> halved(const Plane<uint8_t>& from, const Pinhole& size) {
  return halve(from, size.width, size.height);
}
Plane<uint16_t> halved(const Plane<uint16_t>& from, const Pinhole& size) {
  Plane<uint16_t> half(size.width, size.height);
  cv::Mat to = as_mat(half);
  cv::pyrDown(as_mat(from), to, to.size());
  return half;
}

Plane<uint8_t> zeros(int width, int height) {
  Plane<uint8_t> plane(width, height);
  as_mat(plane).setTo(0);
  return plane;
}

double share_of(const std::shared_ptr<const Plane<uint8_t>>& mask) {
  if (!mask) return 0;
  return double(cv::countNonZero(as_mat(*mask))) / (double(mask->width()) * mask->height());
}

// An image as edges are found in it.
struct RawGray {
  Plane<uint16_t> deep;   // empty for 8 bits
  Plane<uint8_t> shown_;  // of `deep`
  ImageView<uint8_t> pixels;

  explicit RawGray(const GrayImage& image) : pixels(image.view()) {
    if (!image.is_deep()) return;
    deep = deep_gray(image, exposure_of(image));
    shown_ = shown(deep);
    pixels = shown_.view();
  }
};

// What is known about an image besides its gray values.
struct KnownAreas {
  ImageMasks masks;
  std::shared_ptr<const Plane<uint8_t>> likely;
};

}  // namespace

struct PyramidBuilder::Impl {
  // Tables for a residual distortion; immutable, so that builders share them.
  struct LensTables {
    std::optional<Undistortion> undistortion;  // empty if raw images need no change
    Plane<uint8_t> missing;                    // of the rectified images: mask of pixels without a source
  };

  Rectification rectification;
  ImageCorrection correction;
  EdgeParams params;
  std::unique_ptr<EdgeDetector> detector;
  // Null if the detector needs none, or for a builder that only rebuilds.
  std::unique_ptr<EdgeProbability> probability;
  std::shared_ptr<const LensTables> lens;
  std::shared_ptr<const ShiftedUndistortion> rolling = {};  // made for the first image of a rolling shutter
  ImageRows old_rows = {};                                  // of the next image

  const Pinhole& target() const { return rectification.target(); }
  bool has_area() const { return rectification.camera().width > 1 && rectification.camera().height > 1; }

  void make_maps() {
    const auto made = std::make_shared<LensTables>();
    lens = made;
    rolling.reset();
    if ((rectification.is_identity() && correction.keeps_lens()) || !has_area()) return;
    const RectificationMaps maps = rectification.maps(correction);
    made->undistortion.emplace(maps, rectification.camera().width, rectification.camera().height);
    if (!maps.missing.empty()) made->missing = widened(maps);
  }

  // The mask with the pixels around it whose gradients, on the coarsest level with edges, it reaches.
  Plane<uint8_t> widened(const RectificationMaps& maps) const {
    const int margin = kBorderPx << (params.edge_levels - 1);
    const cv::Mat mask(maps.height, maps.width, CV_8UC1, const_cast<uint8_t*>(maps.missing.data()));
    Plane<uint8_t> wide(maps.width, maps.height);
    cv::dilate(mask, as_mat(wide),
               cv::getStructuringElement(cv::MORPH_RECT, {2 * margin + 1, 2 * margin + 1}));
    return wide;
  }

  template <class T>
  Plane<T> undistort(const ImageView<T>& image, const ImageMotion& motion) {
    Plane<T> out(target().width, target().height);
    if (correction.readout_s != 0 && motion.is_known() && has_area()) {
      if (!rolling) rolling = std::make_shared<ShiftedUndistortion>(rectification.maps(correction));
      rolling->apply(rolling_shift(motion), image, &out);
    } else if (lens->undistortion) {
      lens->undistortion->apply(image, &out);
    } else {
      for (int y = 0; y < image.height; ++y)
        std::copy_n(image.data + y * image.stride, image.width, out.row(y));
    }
    return out;
  }

  // Shift of points of the undistorted image in the raw image due to the rolling shutter, at the nodes of a
  // grid.
  ShiftGrid rolling_shift(const ImageMotion& motion) const {
    const Pinhole& p = target();
    ShiftGrid grid(p.width, p.height);
    for (int row = 0; row < grid.rows(); ++row)
      for (int column = 0; column < grid.columns(); ++column) {
        const Eigen::Vector2d x =
            p.ray({double(column * ShiftGrid::kCell), double(row * ShiftGrid::kCell)}).head<2>();
        const Eigen::Vector2d shift =
            raw_pixel(add_rolling(rectification, row_time(correction), motion, x)) - raw_pixel(x);
        if (shift.allFinite()) grid.set(column, row, float(shift.x()), float(shift.y()));  // else 0
      }
    return grid;
  }

  Eigen::Vector2d raw_pixel(const Eigen::Vector2d& x) const {
    return rectification.raw_pixel(add_lens(correction, x));
  }

  // Adds the rows that are not the image's own, and those whose gradients they reach, to a mask of the finest
  // level.
  void cover_old_rows(const GrayImage& image, const ImageMotion& motion, Plane<uint8_t>* area) {
    const int margin = kBorderPx << (params.edge_levels - 1);
    Plane<uint8_t> raw = zeros(image.width, image.height);
    for (int y = std::max(0, old_rows.begin - margin); y < std::min(image.height, old_rows.end + margin); ++y)
      std::fill_n(raw.row(y), image.width, uint8_t(255));
    const Plane<uint8_t> old = undistort(raw.view(), motion);
    if (area->empty()) *area = zeros(old.width(), old.height());
    for (int y = 0; y < old.height(); ++y)
      for (int x = 0; x < old.width(); ++x)
        if (old.row(y)[x]) area->row(y)[x] = 255;
  }

  // `border`, `own`: masks of the finest level, or empty; `likely`: probability on this level, or empty.
  // `observer`: null, or it is given the edges.
  void find_edges(int l, const Plane<uint8_t>& border, const Plane<uint8_t>& own,
                  const Plane<uint8_t>& likely, const ImageMotion& motion, ViewObserver* observer,
                  PyramidLevel* level) {
    Gradient gradient = level->with_gray([](const auto& gray) { return compute_gradient(gray); });
    Plane<uint8_t> mask = detector->detect({level->gray.view(), gradient, likely.view()});
    Plane<uint8_t> shown;  // where it is the image's own
    for (const Plane<uint8_t>* area : {&border, &lens->missing}) {
      if (area->empty()) continue;
      clear_masked(*area, l, &mask);
      if (!observer) continue;
      if (shown.empty()) shown = Plane<uint8_t>(mask.width(), mask.height()), as_mat(shown).setTo(255);
      clear_masked(*area, l, &shown);
    }
    if (!own.empty()) {
      // Also behind the mask: it is taken back if its edges move after all.
      if (observer)
        observer->add_edges(extract_edges(mask, gradient, params.min_chain), gradient, shown, l, correction,
                            motion);
      clear_masked(own, l, &mask);
    }
    level->edges = extract_edges(mask, gradient, params.min_chain);
    if (observer && own.empty()) observer->add_edges(level->edges, gradient, shown, l, correction, motion);
    level->field = NearestField(level->edges, kFieldRadiusPx);
    level->gradient_magnitude = std::move(gradient.magnitude);
  }

  std::shared_ptr<const FramePyramid> take(const GrayImage& image, const std::string& name,
                                           const ImageMotion& motion, ViewObserver* observer);
  // `raw`: of `image`; `observer`: null, or it is given the edges.
  std::shared_ptr<const FramePyramid> build(const GrayImage& image, const RawGray& raw,
                                            const ImageMotion& motion, KnownAreas known,
                                            ViewObserver* observer);
  void fill_level(int l, const RawGray& raw, const ImageMotion& motion, std::vector<PyramidLevel>* levels);
};

double FramePyramid::masked_share() const { return share_of(border_mask); }
double FramePyramid::ego_share() const { return share_of(ego_mask); }

PyramidBuilder::PyramidBuilder(const Rectification& rectification, const EdgeParams& params,
                               const EdgeDetectorTable& detectors)
    : PyramidBuilder(rectification, params, make_edge_detector(params, detectors),
                     make_edge_probability(params, detectors)) {}

PyramidBuilder PyramidBuilder::for_rebuilding(const Rectification& rectification, const EdgeParams& params,
                                              const EdgeDetectorTable& detectors) {
  return PyramidBuilder(rectification, params, make_edge_detector(params, detectors), nullptr);
}

PyramidBuilder::PyramidBuilder(const Rectification& rectification, const EdgeParams& params,
                               std::unique_ptr<EdgeDetector> detector,
                               std::unique_ptr<EdgeProbability> probability)
    : impl_(new Impl{rectification, {}, params, std::move(detector), std::move(probability), {}, {}}) {
  rectification.check("camera");
  impl_->make_maps();
}
PyramidBuilder::~PyramidBuilder() = default;
PyramidBuilder::PyramidBuilder(PyramidBuilder&&) noexcept = default;

const Pinhole& PyramidBuilder::pinhole() const { return impl_->target(); }
ImageCorrection PyramidBuilder::correction() const { return impl_->correction; }

void PyramidBuilder::set_old_rows(const ImageRows& rows) { impl_->old_rows = rows; }

void PyramidBuilder::set_correction(const ImageCorrection& correction) {
  const bool is_other_lens = !correction.has_lens_of(impl_->correction);
  impl_->correction = correction;
  if (is_other_lens) impl_->make_maps();
}

void PyramidBuilder::share_correction(const PyramidBuilder& other) {
  impl_->correction = other.impl_->correction;
  impl_->lens = other.impl_->lens;
  impl_->rolling = other.impl_->rolling;
}

std::shared_ptr<const FramePyramid> PyramidBuilder::build(const GrayImage& image, const ImageMotion& motion,
                                                          ViewObserver* observer) {
  return impl_->take(image, {}, motion, observer);
}

std::shared_ptr<const FramePyramid> PyramidBuilder::build(const Frame& frame, const ImageMotion& motion,
                                                          ViewObserver* observer) {
  return impl_->take(frame.image, image_name(frame), motion, observer);
}

std::shared_ptr<const FramePyramid> PyramidBuilder::Impl::take(const GrayImage& image,
                                                               const std::string& name,
                                                               const ImageMotion& motion,
                                                               ViewObserver* observer) {
  const Camera& expected = rectification.camera();
  if (image.width != expected.width || image.height != expected.height)
    throw InputError("image",
                     "is " + std::to_string(image.width) + "x" + std::to_string(image.height) +
                         " but the camera is " + std::to_string(expected.width) + "x" +
                         std::to_string(expected.height),
                     "give the camera file of these images");
  check_pixels(image, "image");
  const RawGray raw(image);
  std::shared_ptr<const Plane<uint8_t>> likely;
  if (probability) likely = std::make_shared<const Plane<uint8_t>>(probability->estimate(raw.pixels, name));
  const ImageMasks masks = observer ? observer->add_image(raw.pixels) : ImageMasks();
  return build(image, raw, motion, {masks, std::move(likely)},
               observer && observer->wants_edges() ? observer : nullptr);
}

std::shared_ptr<const FramePyramid> PyramidBuilder::rebuild(const FramePyramid& old,
                                                            const ImageMotion& motion) {
  return rebuild(old, motion, {old.border_mask, old.ego_mask});
}

std::shared_ptr<const FramePyramid> PyramidBuilder::rebuild(const FramePyramid& old,
                                                            const ImageMotion& motion,
                                                            const ImageMasks& masks) {
  return impl_->build(old.source, RawGray(old.source), motion, {masks, old.probability}, nullptr);
}

void PyramidBuilder::Impl::fill_level(int l, const RawGray& raw, const ImageMotion& motion,
                                      std::vector<PyramidLevel>* levels) {
  PyramidLevel& level = (*levels)[size_t(l)];
  const PyramidLevel* finer = l > 0 ? &(*levels)[size_t(l - 1)] : nullptr;
  level.pinhole = target().at_level(l);
  if (raw.deep.empty()) {
    level.gray = finer ? halved(finer->gray, level.pinhole) : undistort(raw.pixels, motion);
    return;
  }
  level.deep = finer ? halved(finer->deep, level.pinhole) : undistort(raw.deep.view(), motion);
  level.gray = shown(level.deep);
}

std::shared_ptr<const FramePyramid> PyramidBuilder::Impl::build(const GrayImage& image, const RawGray& raw,
                                                                const ImageMotion& motion, KnownAreas known,
                                                                ViewObserver* observer) {
  auto pyramid = std::make_shared<FramePyramid>();
  pyramid->source = image;
  pyramid->border_mask = std::move(known.masks.border);
  pyramid->ego_mask = std::move(known.masks.ego);
  pyramid->probability = std::move(known.likely);
  pyramid->correction = correction;
  pyramid->levels.resize(size_t(params.levels));
  const Plane<uint8_t> border_here =
      pyramid->border_mask ? undistort(pyramid->border_mask->view(), motion) : Plane<uint8_t>();
  if (pyramid->ego_mask) pyramid->ego_area = undistort(pyramid->ego_mask->view(), motion);
  pyramid->is_torn = !old_rows.empty();
  if (pyramid->is_torn) cover_old_rows(image, motion, &pyramid->ego_area);
  old_rows = {};
  Plane<uint8_t> likely_here =
      pyramid->probability ? undistort(pyramid->probability->view(), motion) : Plane<uint8_t>();
  for (int l = 0; l < params.levels; ++l) {
    PyramidLevel& level = pyramid->levels[size_t(l)];
    fill_level(l, raw, motion, &pyramid->levels);
    if (l > 0 && !likely_here.empty() && l < params.edge_levels)
      likely_here = halved(likely_here, level.pinhole);
    if (l < params.edge_levels)
      find_edges(l, border_here, pyramid->ego_area, likely_here, motion,
                 l == params.edge_levels - 1 ? observer : nullptr, &level);
  }
  return pyramid;
}

}  // namespace edgevo
