// SPDX-License-Identifier: BSD-3-Clause
#include "rescale.h"

#include <iterator>
#include <map>

#include "edgevo/core/record_units.h"

namespace edgevo {
namespace {

SE3 at(const SE3& T, const Eigen::Vector3d& position) { return {T.rotation(), position}; }

// Rebuilds the path step by step.
class Chain {
 public:
  /// The next position along the path in the new unit.
  Eigen::Vector3d next(const Eigen::Vector3d& position, double factor) {
    if (is_first_) {
      rescaled_ = factor * position;
    } else {
      // The scale changes slowly: the mean of both ends is used for the step.
      rescaled_ += 0.5 * (factor + factor_) * (position - position_);
    }
    is_first_ = false;
    position_ = position;
    factor_ = factor;
    return rescaled_;
  }

 private:
  bool is_first_ = true;
  double factor_ = 1;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero(), rescaled_ = Eigen::Vector3d::Zero();
};

struct Move {  // of one frame
  Eigen::Vector3d from, to;
  double factor;
};

std::map<int, Move> move_frames(const std::vector<double>& factors, Run* run) {
  std::map<int, Move> moves;
  Chain chain;
  for (size_t i = 0; i < run->frames.size(); ++i) {
    FrameRecord& f = run->frames[i];
    multiply_lengths(factors[i], &f);
    if (!f.T_world_cam) continue;
    const Eigen::Vector3d from = f.T_world_cam->translation(), to = chain.next(from, factors[i]);
    f.T_world_cam = at(*f.T_world_cam, to);
    moves[f.index] = {from, to, factors[i]};
  }
  return moves;
}

// The frame of a keyframe, or the last one before it that has a pose.
const Move& move_of(const std::map<int, Move>& moves, int frame_index) {
  const auto after = moves.upper_bound(frame_index);
  return after == moves.begin() ? after->second : std::prev(after)->second;
}

}  // namespace

void rescale_final(const std::vector<double>& factors, Run* run) {
  const std::map<int, Move> moves = move_frames(factors, run);
  if (moves.empty()) return;
  for (KeyframeRecord& k : run->keyframes) {
    const Move& move = move_of(moves, k.frame_index);
    k.T_world_cam = at(k.T_world_cam, move.to + move.factor * (k.T_world_cam.translation() - move.from));
    multiply_depths(move.factor, &k);
  }
}

void rescale_live(const std::vector<double>& factors, Run* run) {
  Chain chain;
  for (size_t i = 0; i < run->frames.size(); ++i) {
    auto& T = run->frames[i].T_world_cam_live;
    if (T) T = at(*T, chain.next(T->translation(), factors[i]));
  }
}

}  // namespace edgevo
