// SPDX-License-Identifier: BSD-3-Clause
#include "stated_poses.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace edgevo {
namespace {

const double kLog2Pi = std::log(2 * EIGEN_PI);

// ln N(d; 0, covariance).
double log_density(const Vector6d& d, const Matrix6d& covariance) {
  const Eigen::LDLT<Matrix6d> factored(covariance);
  return -0.5 * (d.dot(factored.solve(d)) + factored.vectorD().array().log().sum() + 6 * kLog2Pi);
}

// From one pose to another: position in the frame, rotation from the left.
Vector6d difference(const SE3& from, const SE3& to) {
  const Eigen::AngleAxisd turn(to.rotation() * from.rotation().conjugate());
  Vector6d d;
  d << to.translation() - from.translation(), turn.angle() * turn.axis();
  return d;
}

double log_beta(double a, double b) { return std::lgamma(a) + std::lgamma(b) - std::lgamma(a + b); }

// What the choices are made from: the views, then the guess.
struct Statements {
  std::vector<StatedPose> all;
  size_t views = 0;
  double guess_fails = 0;
  MistakenViews known;
  double log_unknown = 0;  // ln U

  // Logarithm of the prior of a choice, times the density of what does not hold.
  double log_prior(const std::vector<bool>& holds) const {
    const auto right = double(std::count(holds.begin(), holds.begin() + long(views), true));
    const double mistaken = double(views) - right;
    double log = log_beta(known.mistaken + mistaken, known.right + right) + mistaken * log_unknown;
    if (views < all.size()) log += holds[views] ? std::log(1 - guess_fails) : log_of_failure();
    return log;
  }

 private:
  double log_of_failure() const {
    constexpr double kImpossible = -1e9;
    return guess_fails > 0 ? std::log(guess_fails) + log_unknown : kImpossible;
  }
};

// Statements that hold together, and what they say.
class Choice {
 public:
  Choice(const Statements& statements, size_t first)
      : of_(statements),
        holds_(statements.all.size(), false),
        origin_(statements.all[first].T_frame_cam),
        covariance_(statements.all[first].covariance) {
    holds_[first] = true;
    while (add_best()) {
    }
  }
  double log_probability() const { return log_density_ + of_.log_prior(holds_); }
  const std::vector<bool>& holds() const { return holds_; }

 private:
  double log_density_with(size_t k) const {
    return log_density(difference(origin_, of_.all[k].T_frame_cam) - mean_,
                       covariance_ + of_.all[k].covariance);
  }
  double gain(size_t k) const {
    std::vector<bool> with = holds_;
    with[k] = true;
    return log_density_with(k) + of_.log_prior(with) - of_.log_prior(holds_);
  }
  bool add_best() {
    std::optional<size_t> best;
    double most = 0;
    for (size_t k = 0; k < holds_.size(); ++k) {
      if (holds_[k]) continue;
      if (const double gained = gain(k); gained > most) most = gained, best = k;
    }
    if (best) fuse(*best);
    return best.has_value();
  }
  void fuse(size_t k) {
    log_density_ += log_density_with(k);
    const Matrix6d weight = covariance_ * (covariance_ + of_.all[k].covariance).inverse();
    mean_ += weight * (difference(origin_, of_.all[k].T_frame_cam) - mean_);
    covariance_ = (weight * of_.all[k].covariance).eval();
    holds_[k] = true;
  }

  const Statements& of_;
  std::vector<bool> holds_;
  SE3 origin_;
  Vector6d mean_ = Vector6d::Zero();  // about it
  Matrix6d covariance_;
  double log_density_ = 0;
};

}  // namespace

// With T_a_cam = T_a_b T_b_cam and a turn w about the centre c:  dp = v + w x (p - c).
StatedPose state_pose(const std::vector<Constraint>& constraints, const SE3& T_last_cam) {
  std::vector<SE3> T_frame_cam{T_last_cam};  // from the last frame to the first
  for (auto c = constraints.rbegin(); c != constraints.rend(); ++c)
    T_frame_cam.push_back(c->T_from_to.rigid * T_frame_cam.back());
  StatedPose statement{T_frame_cam.back(), Matrix6d::Zero()};
  Eigen::Matrix3d R_first = Eigen::Matrix3d::Identity();  // of the frame of a constraint
  for (size_t i = 0; i < constraints.size(); ++i) {
    const Constraint& c = constraints[i];
    const Eigen::Vector3d arm = T_frame_cam[constraints.size() - i].translation() - c.centre;
    Matrix6d effect = Matrix6d::Identity();
    effect.topRightCorner<3, 3>() << 0, arm.z(), -arm.y(), -arm.z(), 0, arm.x(), arm.y(), -arm.x(), 0;
    Matrix6d turn = Matrix6d::Zero();
    turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = R_first;
    effect = (turn * effect).eval();
    statement.covariance += effect * c.covariance.topLeftCorner<6, 6>() * effect.transpose();
    R_first = (R_first * c.T_from_to.rigid.R()).eval();
  }
  return statement;
}

std::vector<bool> views_that_hold(const std::vector<StatedPose>& views,
                                  const std::optional<GuessedPose>& guess, const MistakenViews& known,
                                  const UnknownPose& unknown) {
  if (views.empty()) return {};
  Statements statements{views, views.size(), 0, known, 0};
  // As little as the guess says, a mistaken view shows a pose about it.
  Matrix6d spread = Matrix6d::Zero();
  spread.diagonal() << Eigen::Vector3d::Constant(unknown.position * unknown.position),
      Eigen::Vector3d::Constant(unknown.rotation * unknown.rotation);
  if (guess) spread += guess->stated.covariance;
  statements.log_unknown = log_density(Vector6d::Zero(), spread);
  if (guess) statements.all.push_back(guess->stated), statements.guess_fails = guess->fails;
  std::optional<Choice> best;
  for (size_t first = 0; first < statements.all.size(); ++first) {
    Choice choice(statements, first);
    if (!best || choice.log_probability() > best->log_probability()) best.emplace(std::move(choice));
  }
  std::vector<bool> holds = best->holds();
  holds.resize(views.size());
  return holds;
}

}  // namespace edgevo
