// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Bodies that do not belong to the scene, pasted over the images of any sequence, with the exact truth of
// which pixel belongs to what: to test an odometry on views with more than one motion.
//
//   own part       fixed to the camera: a `gripper` (textured rectangle at the lower border), a `plain` one
//                  (uniform, only its outline is an edge), a `dashboard` (instruments, curved rim, over the
//                  whole width), an `arm` (a gripper with its shadow next to it), a `bonnet` (curved rim,
//                  over the whole width, reflects what is above the horizon), a `bow` (pointed, planks)
//   vehicle ahead  the rear of a lorry, three seconds after the beginning: caught up with for four seconds,
//                  followed for two, gone in four
//   passing        lorries on the next lane, seen from 1.65 m above the road: `oncoming` every 3.5 s,
//                  or `overtaking` every 6 s, which move in ahead
//   crossing       a bus that drives through the view from left to right while the camera stands
//
// Sizes in pixels are for a width of 1241 and scale with it. Bodies carry sensor noise of 1.5 gray levels,
// drawn from the seed. The result for a frame depends on the options, its number and its time only.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/image.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/simulation/texture.h"

namespace edgevo {

/// The kinds of own parts above, in that order.
const std::vector<std::string>& own_part_kinds();
/// The kinds of vehicles that pass, in that order.
const std::vector<std::string>& passing_kinds();

/// What to paste over a sequence, and where the camera stands.
struct OverlayOptions {
  /// One of own_part_kinds(); empty: none.
  std::string own_part;
  /// Share of the image that the own part covers, 0.01 to 0.5; 0: a tenth, of a dashboard three tenths, a
  /// bonnet two, a bow one and a half.
  double part_share = 0;
  /// Width of the vehicle ahead at its nearest, pixels of an image 1241 wide; 0: none.
  double vehicle_px = 0;
  /// One of passing_kinds(); empty: none.
  std::string passing;
  /// Length of the bus that crosses while the camera stands, pixels of an image 1241 wide; 0: none.
  double crossing_px = 0;
  /// Frames that the camera stands: the frame `stop_at` is repeated with noise of two gray levels; 0: none.
  int standing = 0;
  /// Frame that is repeated, counted from the first one of the sequence.
  int stop_at = 0;
  /// Seed of textures and noise.
  uint64_t seed = 1;
};

/// A frame with what was pasted over it.
struct OverlaidImage {
  /// The image.
  GrayImage image;
  /// 255 where the scene is seen, 0 where a body that moves by itself hides it; empty if there is none now.
  std::vector<uint8_t> moving;
};

/// Pastes bodies over images of one size. Stateless after its construction; any thread.
class Overlay {
 public:
  /// Throws InputError for an unknown kind, values out of range or options that ask for nothing.
  Overlay(const OverlayOptions& options, int width, int height);

  /// Pastes over frame `index` of the new sequence, `seconds` after its beginning. `standing` is the number
  /// of the frame among those of a standing camera, from 0; nullopt while it moves.
  OverlaidImage apply(const GrayImage& image, int index, double seconds, std::optional<int> standing) const;
  /// Mask of the own part, 255 where the scene is seen, 0 on the part; empty if there is none.
  const std::vector<uint8_t>& own_part_mask() const { return ego_mask_; }
  /// The options.
  const OverlayOptions& options() const { return options_; }

 private:
  struct BodyBox {
    double left, top, right, bottom;
  };
  BodyBox own_place() const;
  std::optional<BodyBox> vehicle_place(double seconds) const;
  std::optional<BodyBox> passing_place(double seconds) const;
  BodyBox crossing_place(int standing) const;
  void shade(const BodyBox& arm, GrayImage* image, std::vector<uint8_t>* mask) const;
  void reflect(const GrayImage& scene, const std::vector<uint8_t>& mask, GrayImage* image) const;
  void paste_own(int index, const GrayImage& scene, GrayImage* image, std::vector<uint8_t>* mask) const;
  void paste(const Texture& texture, const BodyBox& place, int index, GrayImage* image,
             std::vector<uint8_t>* mask) const;

  OverlayOptions options_;
  int width_, height_;
  Texture own_, lorry_, bus_;
  std::vector<uint8_t> ego_mask_;
};

/// Ground truth in the TUM format of a sequence in which the camera stands for `frames` frames, `step_s`
/// apart, after `at`: later poses are moved back, the pose at `at` is repeated.
std::string ground_truth_with_stop(const std::string& tum, Timestamp at, double step_s, int frames);

}  // namespace edgevo
