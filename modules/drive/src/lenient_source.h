#pragma once
#include <map>
#include <mutex>
#include <string>

#include "edgevo/core/bad_frame.h"
#include "edgevo/core/image_source.h"

namespace edgevo {

/// Another source whose bad frames (core/bad_frame.h) come out without their image, instead of as a throw.
/// But one that comes before any good frame is thrown: then it is not the frame that is wrong, but the
/// source.
class LenientSource : public ImageSource {
 public:
  explicit LenientSource(ImageSource& inner) : inner_(inner) {}

  const Camera& camera() const override { return inner_.camera(); }
  std::optional<int> size() const override { return inner_.size(); }
  std::string kind() const override { return inner_.kind(); }
  bool is_live() const override { return inner_.is_live(); }
  std::optional<Frame> next() override;

  /// What is wrong with a frame that came without its image, told once. In any thread.
  std::string take_reason(int frame_index);

 private:
  ImageSource& inner_;
  bool good_came_ = false;
  std::mutex mutex_;  // guards what follows
  std::map<int, std::string> reasons_;
};

}  // namespace edgevo
