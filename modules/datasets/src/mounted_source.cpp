// SPDX-License-Identifier: BSD-3-Clause
#include "mounted_source.h"

#include "edgevo/core/wrapped_source.h"

namespace edgevo {
namespace {

// Angles that differ by less are the same mount, written with other digits.
constexpr double kSameMount = 1e-3;

InputDecision decide(const ImageSource& source, const CameraMount& mount, const std::string& given_by) {
  const SE3 T = T_vehicle_cam(mount);
  InputDecision decision{"mount", describe(mount), given_by, ""};
  const std::optional<SE3> own = source.T_vehicle_cam();
  if (own && (own->inverse() * T).log().norm() > kSameMount)
    decision.reason += "; that of the source, which " + describe(camera_mount(*own)) + ", is not used";
  return decision;
}

class MountedSource : public WrappedSource {
 public:
  MountedSource(std::unique_ptr<ImageSource> inner, const CameraMount& mount, const std::string& given_by)
      : WrappedSource(std::move(inner)),
        T_vehicle_cam_(edgevo::T_vehicle_cam(mount)),
        decision_(decide(this->inner(), mount, given_by)) {}

  std::optional<SE3> T_vehicle_cam() const override { return T_vehicle_cam_; }
  std::vector<InputDecision> decisions() const override {
    auto all = inner().decisions();
    all.push_back(decision_);
    return all;
  }

 private:
  SE3 T_vehicle_cam_;
  InputDecision decision_;
};

}  // namespace

std::unique_ptr<ImageSource> mount_source(std::unique_ptr<ImageSource> inner, const CameraMount& mount,
                                          const std::string& given_by) {
  return std::make_unique<MountedSource>(std::move(inner), mount, given_by);
}

}  // namespace edgevo
