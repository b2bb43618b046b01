// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/datasets/mounted_source.h"

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

class MountedSource : public ImageSource {
 public:
  MountedSource(std::unique_ptr<ImageSource> inner, const CameraMount& mount, const std::string& given_by)
      : inner_(std::move(inner)),
        T_vehicle_cam_(edgevo::T_vehicle_cam(mount)),
        decision_(decide(*inner_, mount, given_by)) {}

  const Camera& camera() const override { return inner_->camera(); }
  std::optional<SE3> T_vehicle_cam() const override { return T_vehicle_cam_; }
  VehicleTrack vehicle_track(VehicleSensor sensor) const override { return inner_->vehicle_track(sensor); }
  std::optional<int> size() const override { return inner_->size(); }
  std::string kind() const override { return inner_->kind(); }
  bool is_live() const override { return inner_->is_live(); }
  std::string label() const override { return inner_->label(); }
  std::vector<std::pair<std::string, std::string>> details() const override { return inner_->details(); }
  std::vector<InputDecision> decisions() const override {
    auto all = inner_->decisions();
    all.push_back(decision_);
    return all;
  }
  std::vector<Timestamp> times() const override { return inner_->times(); }
  std::string ground_truth_path() const override { return inner_->ground_truth_path(); }
  std::optional<Frame> next() override { return inner_->next(); }
  bool skip() override { return inner_->skip(); }

 private:
  std::unique_ptr<ImageSource> inner_;
  SE3 T_vehicle_cam_;
  InputDecision decision_;
};

}  // namespace

std::unique_ptr<ImageSource> mount_source(std::unique_ptr<ImageSource> inner, const CameraMount& mount,
                                          const std::string& given_by) {
  return std::make_unique<MountedSource>(std::move(inner), mount, given_by);
}

}  // namespace edgevo
