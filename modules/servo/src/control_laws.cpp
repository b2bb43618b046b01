// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/servo/control_laws.h"

#include <visp3/core/vpMath.h>
#include <visp3/visual_features/vpFeatureThetaU.h>
#include <visp3/visual_features/vpFeatureTranslation.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace edgevo {
namespace {

constexpr double kMaxSpeed = 0.25, kMaxTurn = 0.8;  // metres and radians per second
constexpr double kGoal_m = 0.001, kGoal_deg = 0.1, kGoal_px = 0.25;
constexpr int kMinPoints = 4;

// The velocity, scaled down to the limits of the robot.
vpColVector limited(vpColVector v) {
  double share = 1;
  for (unsigned i = 0; i < 6; ++i)
    share = std::min(share, (i < 3 ? kMaxSpeed : kMaxTurn) / std::max(std::abs(v[i]), 1e-12));
  return v * share;
}

Command stop(const std::string& why) {
  Command command;
  command.stop = why;
  return command;
}

void set_eye_in_hand(double gain, vpServo* task) {
  task->setServo(vpServo::EYEINHAND_CAMERA);
  task->setInteractionMatrixType(vpServo::CURRENT);
  task->setLambda(gain);
}

class TaughtLaw : public ControlLaw {
 public:
  TaughtLaw(const Pinhole& pinhole, int count) : pinhole_(pinhole), points_(pinhole), count_(count) {}

  bool teach(const ServoPose& pose, std::string* why) override {
    if (!pose.usable) return *why = pose.reason, false;
    if (points_.choose(pose, count_) < kMinPoints)
      return *why = "too few edge points of known depth in view", false;
    take_map(pose.map_version);
    set_goal(pose, points_.features(pose));
    return true;
  }

  Command command(const ServoPose& pose) override {
    if (!pose.usable) return stop(pose.reason);
    if (pose.map_version != map_version_)
      return stop("a new map: the goal belongs to another one; teach again");
    Command command = law(pose);
    command.velocity = limited(command.velocity);
    return command;
  }

  std::vector<ServoPoint> points(const ServoPose& pose) override { return points_.features(pose); }

 protected:
  virtual void set_goal(const ServoPose& pose, const std::vector<ServoPoint>& points) = 0;
  virtual Command law(const ServoPose& pose) = 0;
  void take_map(int version) { map_version_ = version; }

  Pinhole pinhole_;
  ServoPoints points_;

 private:
  int count_, map_version_ = -1;
};

// Moves the pose of the camera in the taught camera's axes to the identity.
class Pbvs : public TaughtLaw {
 public:
  Pbvs(const Pinhole& pinhole, double gain, int count)
      : TaughtLaw(pinhole, count), t_(vpFeatureTranslation::cdMc), tu_(vpFeatureThetaU::cdRc) {
    set_eye_in_hand(gain, &task_);
    task_.addFeature(t_);
    task_.addFeature(tu_);
  }

  void aim(const vpHomogeneousMatrix& cdMw, int map_version) override {
    take_map(map_version);
    cdMw_ = cdMw;
  }

 private:
  void set_goal(const ServoPose& pose, const std::vector<ServoPoint>&) override { cdMw_ = pose.cMw; }

  Command law(const ServoPose& pose) override {
    const vpHomogeneousMatrix cdMc = cdMw_ * pose.cMw.inverse();
    t_.buildFrom(cdMc);
    tu_.buildFrom(cdMc);
    Command command;
    command.velocity = task_.computeControlLaw();
    command.translation_m = cdMc.getTranslationVector().frobeniusNorm();
    command.rotation_deg = vpMath::deg(vpColVector(cdMc.getThetaUVector()).frobeniusNorm());
    command.at_goal = command.translation_m < kGoal_m && command.rotation_deg < kGoal_deg;
    return command;
  }

  vpServo task_;
  vpFeatureTranslation t_;
  vpFeatureThetaU tu_;
  vpHomogeneousMatrix cdMw_;
};

// Moves the points of the feed to their positions in the taught image; Z is that of the feed.
class Ibvs : public TaughtLaw {
 public:
  Ibvs(const Pinhole& pinhole, double gain, int count) : TaughtLaw(pinhole, count), gain_(gain) {}

  void aim(const vpHomogeneousMatrix&, int) override {
    throw std::logic_error("IBVS steers by points that were taught");
  }

 private:
  void set_goal(const ServoPose&, const std::vector<ServoPoint>& points) override {
    desired_.clear();
    current_.clear();
    for (const ServoPoint& p : points) desired_.push_back(p.point);
    current_ = desired_;
    task_ = std::make_unique<vpServo>();
    set_eye_in_hand(gain_, task_.get());
    for (size_t i = 0; i < desired_.size(); ++i) task_->addFeature(current_[i], desired_[i]);
  }

  Command law(const ServoPose& pose) override {
    const std::vector<ServoPoint> points = points_.features(pose);
    double square = 0;
    for (size_t i = 0; i < points.size(); ++i) {
      if (!(points[i].point.get_Z() > 0)) return stop("a point is behind the camera");
      current_[i].set_xyZ(points[i].point.get_x(), points[i].point.get_y(), points[i].point.get_Z());
      square += std::pow(pinhole_.fx * (current_[i].get_x() - desired_[i].get_x()), 2) +
                std::pow(pinhole_.fy * (current_[i].get_y() - desired_[i].get_y()), 2);
    }
    Command command;
    command.velocity = task_->computeControlLaw();
    command.image_px = std::sqrt(square / double(points.size()));
    command.at_goal = command.image_px < kGoal_px;
    return command;
  }

  double gain_;
  std::unique_ptr<vpServo> task_;
  std::vector<vpFeaturePoint> desired_, current_;  // the task holds pointers to them
};

}  // namespace

std::unique_ptr<ControlLaw> make_control_law(const std::string& law, const Pinhole& pinhole, double gain,
                                             int points) {
  if (law == "ibvs") return std::make_unique<Ibvs>(pinhole, gain, points);
  return std::make_unique<Pbvs>(pinhole, gain, points);
}

}  // namespace edgevo
