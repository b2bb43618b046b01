// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <deque>
#include <exception>
#include <optional>

#include "edgevo/core/image_source.h"

namespace edgevo {

/// Wraps a source whose first frames are read twice: what next() gives until read_again() comes again after
/// it, also what it throws.
class FirstFrames : public ImageSource {
 public:
  explicit FirstFrames(ImageSource& inner) : inner_(inner) {}

  const Camera& camera() const override { return inner_.camera(); }
  std::optional<int> size() const override { return inner_.size(); }
  std::string kind() const override { return inner_.kind(); }
  bool is_live() const override { return inner_.is_live(); }
  GyroReadings gyro_readings() const override { return inner_.gyro_readings(); }
  std::optional<Frame> next() override;

  /// Keeps what next() gives from now on.
  void keep() { keeps_ = true; }
  /// Size of the images that are kept.
  size_t kept_bytes() const { return kept_bytes_; }
  /// Goes back to the first that was kept.
  void read_again() { keeps_ = false; }

 private:
  // What one call gave.
  struct Answer {
    std::optional<Frame> frame;
    std::exception_ptr thrown;
  };
  Answer read();

  ImageSource& inner_;
  bool keeps_ = false;
  size_t kept_bytes_ = 0;
  std::deque<Answer> kept_;
};

}  // namespace edgevo
