// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/map/epochs.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "doubtful_course.h"
#include "edgevo/core/angle.h"
#include "edgevo/core/motion_tolerance.h"
#include "epoch_constraints.h"
#include "keyframe_graph.h"
#include "stated_poses.h"
#include "unit_guess.h"

namespace edgevo {
namespace {

// Of a doubt that was groundless: standard deviations of the unit (logarithm), of the rotation, and of the
// translation as a share of its length. By what corresponds to them in drives without a doubt.
constexpr double kKeptScale = 0.01, kKeptRotation = rad(0.2), kKeptShare = 0.01;
// Share of doubts that end with another unit: chosen, between the 2 % of right frames that are doubted and
// the half of provoked failures after which a unit is another one.
constexpr double kLostProbability = 0.3;
// That a guess by constant velocity fails, and that features mistake the unit. Chosen by their order, not
// fitted: places that look alike are commoner than bent maps, and a camera seldom leaves
// what its speed says by sigmas.
constexpr double kGuessFails = 0.05, kUnitMistaken = 0.1;
// Of the place after a doubt whose keyframes are not known (any more), and of a join without a velocity: ten
// median depths of a first map.
constexpr double kUnknownCourse = 100;
// Of a join, however slow the camera was: the tolerance of a right motion, 2 % of the median depth of a first
// map.
constexpr double kLeastJoin = 0.2;
// Of a unit that is mistaken (logarithm): that of a bent map.
constexpr double kMistakenScale = 0.3;

// Of what is known of features before a run: one place of five is mistaken, and where one is, others are.
constexpr MistakenViews kMistakenViews{0.25, 1};
// Where a view lies that looks alike, or a camera whose guess fails: three median depths of a first map, and
// any direction.
constexpr UnknownPose kMistaken{30, kUnknownRotation};

double squared(double x) { return x * x; }

// A pose of an adjustment that failed must not end the run.
bool is_sound(const KeyframeInMap& k) { return k.T_map_cam.is_finite(); }
bool is_sound(const Sim3& T) { return T.rigid.is_finite() && T.scale > 0 && std::isfinite(T.scale); }

}  // namespace

// ---- the places ----

const EpochPlace* PlacedEpochs::find(int segment, int keyframe_id) const {
  const EpochPlace* found = nullptr;
  for (const EpochPlace& e : epochs)
    if (e.segment == segment && (!found || e.first_keyframe <= keyframe_id)) found = &e;
  return found;
}

const Sim3& PlacedEpochs::T_world_map(int segment, int keyframe_id) const {
  const auto known = own.find(keyframe_id);
  return known != own.end() ? known->second : find(segment, keyframe_id)->T_world_map;
}

// ---- what is known ----

void Epochs::begin_segment(const SegmentPlaced& placed, const Sim3& T_world_previous) {
  Epoch epoch;
  epoch.place = {placed.segment, 0, -1, placed.T_world_map, placed.scale_sigma};
  // Of a segment that features link, or that no velocity places, hardly anything is known but by constraints.
  const bool is_guess = placed.rotation_sigma > 0;
  epoch.rotation_sigma = is_guess ? placed.rotation_sigma : kUnknownRotation;
  epoch.position_sigma =
      is_guess ? std::max(placed.position_sigma / T_world_previous.scale, kLeastJoin) : kUnknownCourse;
  epoch.join_sigma = is_guess && placed.scale_sigma > 0 ? placed.scale_sigma : kUnknownScale;
  if (!epochs_.empty() && is_sound(placed.T_world_map))
    epoch.T_previous = T_world_previous.inverse() * placed.T_world_map;
  epochs_.push_back(std::move(epoch));
}

void Epochs::begin_epoch(const EpochBegan& began) {
  // With frames in time a doubt may be evaluated when the next segment has begun.
  const auto after = std::find_if(epochs_.rbegin(), epochs_.rend(),
                                  [&](const Epoch& e) { return e.place.segment == began.segment; });
  if (after == epochs_.rend() || began.first <= after->place.first_keyframe) return;
  Epoch epoch;
  epoch.place = {began.segment, after->place.epoch + 1, began.first, after->place.T_world_map, kUnknownScale};
  epoch.last_before = std::min(began.last_before, began.first);
  epoch.unit_sigma = began.unit_sigma;
  epoch.is_doubted = began.is_doubted;
  epochs_.insert(after.base(), std::move(epoch));
}

bool Epochs::refers_to(int keyframe_id) const {
  const NodeId node = NodeId::keyframe(keyframe_id);
  return std::any_of(constraints_.begin(), constraints_.end(),
                     [&](const auto& c) { return c.second.from == node || c.second.to == node; }) ||
         std::any_of(epochs_.begin(), epochs_.end(), [&](const Epoch& e) {
           return e.last_before == keyframe_id || e.place.first_keyframe == keyframe_id;
         });
}

// ---- the solution ----

// First the units, by what measures units, then the places by these units: so no error of a place, which
// grows with the path to it, is taken for one of the unit.
class Epochs::Solver {
 public:
  Solver(const Epochs& known, const RunSoFar& run)
      : epochs_(known.epochs_), run_(run), scales_(epochs_.size(), 1.0) {
    for (size_t i = 0; i < epochs_.size(); ++i) courses_.push_back(course_before(i));
    for (const auto& [id, c] : known.constraints_) reduce(id, c);
  }

  PlacedEpochs solve() {
    PlacedEpochs placed;
    for (const Epoch& e : epochs_) placed.epochs.push_back(e.place);
    if (!constraints_.empty()) {
      find_units(&placed);
      find_places(&placed);
    }
    add_unknown_variance(&placed);
    for (size_t i = 1; i < epochs_.size(); ++i) place_between(i, &placed);
    return placed;
  }

 private:
  struct Reduced {  // a constraint between epochs
    int id;
    size_t from, to;
    SE3 T_map_from, T_map_to;  // of its keyframes
    Constraint constraint;
  };

  // The first epoch is the world.
  NodeId node(size_t i) const {
    return i == 0 ? NodeId::world() : NodeId::epoch(epochs_[i].place.segment, epochs_[i].place.epoch);
  }
  bool continues(size_t i) const { return epochs_[i].last_before >= 0; }

  std::optional<DoubtfulCourse> course_before(size_t i) const {
    if (!continues(i)) return std::nullopt;
    const EpochPlace& place = epochs_[i].place;
    std::vector<KeyframeInMap> keyframes =
        run_.keyframes(place.segment, epochs_[i].last_before, place.first_keyframe);
    const bool all =
        std::all_of(keyframes.begin(), keyframes.end(), [](const auto& k) { return is_sound(k); });
    if (keyframes.size() < 2 || !all) return std::nullopt;
    return DoubtfulCourse(std::move(keyframes), run_.doubt);
  }

  std::optional<size_t> epoch_of(const KeyframeInMap& k) const {
    std::optional<size_t> found;
    for (size_t i = 0; i < epochs_.size(); ++i) {
      const EpochPlace& e = epochs_[i].place;
      if (e.segment == k.segment && (!found || e.first_keyframe <= k.id)) found = i;
    }
    return found;
  }

  // One whose keyframes are not known, or of one epoch, says nothing of epochs.
  void reduce(int id, const Constraint& c) {
    if (c.from.kind() != NodeId::Kind::kKeyframe || c.to.kind() != NodeId::Kind::kKeyframe) return;
    const auto from = run_.keyframe(c.from.number()), to = run_.keyframe(c.to.number());
    if (!from || !to || !is_sound(*from) || !is_sound(*to)) return;
    const auto a = epoch_of(*from), b = epoch_of(*to);
    if (!a || !b || a == b) return;
    constraints_.push_back({id, *a, *b, from->T_map_cam, to->T_map_cam, with_uncertain_scale(c)});
    constraints_.back().constraint.from = node(*a), constraints_.back().constraint.to = node(*b);
  }

  // To the epoch before.
  Constraint join(size_t i, const Sim3& T_from_to) const {
    Constraint c;
    c.from = node(i - 1), c.to = node(i);
    c.T_from_to = T_from_to;
    c.kind = ConstraintKind::kContinuity;
    return c;
  }

  // One that features link has constraints of its own, but those may turn out to be mistaken.
  bool is_joined(size_t i) const { return epochs_[i].T_previous.has_value(); }

  Constraint continuity_of_unit(size_t i) const {
    Constraint c = join(i, Sim3());
    c.covariance = covariance_of_scale(std::hypot(kKeptScale, epochs_[i].unit_sigma));
    if (epochs_[i].is_doubted) c.failure = {kLostProbability, covariance_of_scale(kUnknownScale)};
    return c;
  }
  Constraint join_of_segment(size_t i) const {
    const Epoch& e = epochs_[i];
    Constraint c = join(i, *e.T_previous);
    c.covariance = covariance_of(e.position_sigma, e.rotation_sigma, e.join_sigma);
    c.centre = c.T_from_to.rigid.translation();
    return c;
  }

  // ---- units ----

  // Depths that share a young or bent map have errors in common, which their spread does not show.
  static Constraint link_of_unit(const Reduced& r) {
    Constraint c = of_scale_alone(r.constraint);
    if (!c.failure)
      c.failure = {kUnitMistaken,
                   covariance_of_scale(std::max(kMistakenScale, std::sqrt(c.covariance(6, 6))))};
    return c;
  }
  void find_units(PlacedEpochs* placed) {
    std::vector<UnitRelation> relations;
    std::map<size_t, size_t> continuity;  // position in `relations` -> epoch
    std::map<size_t, int> id_of;
    for (size_t i = 1; i < epochs_.size(); ++i) {
      if (continues(i))
        continuity[relations.size()] = i, relations.push_back({i - 1, i, continuity_of_unit(i)});
      if (is_joined(i)) relations.push_back({i - 1, i, of_scale_alone(join_of_segment(i))});
    }
    for (const Reduced& r : constraints_)
      if (measures_unit(r.constraint))
        id_of[relations.size()] = r.id, relations.push_back({r.from, r.to, link_of_unit(r)});
    const GraphSolution found = solve_units(relations);
    for (const int failed : found.failed) {
      if (const auto c = continuity.find(size_t(failed)); c != continuity.end()) lost_.insert(c->second);
      if (const auto c = id_of.find(size_t(failed)); c != id_of.end()) placed->unused.push_back(c->second);
    }
    for (size_t i = 1; i < epochs_.size(); ++i) {
      const NodeSolution& solution = found.nodes.at(node(i));
      scales_[i] = solution.T_world_node.scale;
      placed->epochs[i].scale_sigma = solution.log_scale_sigma;
    }
  }

  GraphSolution solve_units(const std::vector<UnitRelation>& relations) const {
    const std::vector<double> guess = guess_units(epochs_.size(), relations);
    MapGraph graph;
    for (size_t i = 1; i < epochs_.size(); ++i) graph.add_node(node(i), {std::exp(guess[i]), SE3()});
    for (const UnitRelation& r : relations) graph.add(r.constraint);
    return graph.solve(MapGraph::Sigmas::kEpochs);
  }

  // ---- places ----

  double ratio(size_t from, size_t to) const { return scales_[to] / scales_[from]; }

  // The same map: what lies after the doubt may have turned and moved about the end of the course.
  Constraint continuity_of_place(size_t i) const {
    Constraint c = join(i, {ratio(i - 1, i), SE3()});
    if (!courses_[i]) {
      c.covariance = covariance_of(kUnknownCourse, kKeptRotation, 1);
      return c;
    }
    const DoubtfulCourse& course = *courses_[i];
    c.centre = course.end(c.T_from_to.scale);
    const Eigen::Vector3d last = course.keyframes().back().T_map_cam.translation();
    c.T_from_to.rigid = SE3(Eigen::Quaterniond::Identity(), c.centre - c.T_from_to.scale * last);
    const double tolerances = std::sqrt(double(course.frames()) / kMotionTolerance.frames);
    c.covariance = lost_.count(i) == 0 ? covariance_of(kKeptShare * course.length(), kKeptRotation, 1)
                                       : covariance_of(course.length() * std::max(1.0, c.T_from_to.scale),
                                                       rad(kMotionTolerance.rotation_deg) * tolerances, 1);
    return c;
  }
  std::optional<Constraint> join_of_place(size_t i) const {
    if (continues(i)) return continuity_of_place(i);
    return is_joined(i) ? std::optional(join_of_segment(i)) : std::nullopt;
  }
  // Those whose unit is not contradicted.
  static std::vector<Reduced> links_of_places(const std::vector<Reduced>& all, const PlacedEpochs& by_units) {
    std::vector<Reduced> links;
    for (const Reduced& r : all)
      if (measures_place(r.constraint) && !by_units.is_unused(r.id)) links.push_back(r);
    return links;
  }
  // An epoch is not as rigid as such places are certain: where they contradict each other is known once they
  // move its keyframes (place_keyframes()).
  static bool is_seen_again(const Reduced& r) { return r.constraint.kind == ConstraintKind::kPlace; }
  Constraint link_of_place(const Reduced& r) const {
    return between_maps(r.constraint, r.T_map_from, r.T_map_to, ratio(r.from, r.to));
  }

  Constraint in_world(const Reduced& r, const std::optional<UnknownPose>& mistaken = {}) const {
    return in_world_unit(link_of_place(r), scales_[r.from], mistaken);
  }
  Constraint in_world(size_t i, const Constraint& join) const {
    return in_world_unit(join, scales_[i - 1], continues(i) ? std::nullopt : std::optional(kMistaken));
  }

  // What is expected of a camera by the joins between two epochs alone; nothing if one is not joined.
  std::optional<GuessedPose> expected_pose(const Reduced& r, const SE3& T_to_cam) const {
    std::vector<Constraint> joins;
    double right = 1;
    for (size_t i = r.from + 1; i <= r.to; ++i) {
      const auto join = join_of_place(i);
      if (!join) return std::nullopt;
      joins.push_back(in_world(i, *join));
      if (!continues(i)) right *= 1 - kGuessFails;
    }
    return GuessedPose{state_pose(joins, T_to_cam), 1 - right};
  }

  // Of the links that show the same epochs, in time order: whether they hold, by what they say of the camera
  // that the first one names.
  std::vector<bool> hold(const std::vector<const Reduced*>& links, const MistakenViews& known) const {
    const Reduced& first = *links.front();
    const SE3 T_to_cam(first.T_map_to.rotation(), scales_[first.to] * first.T_map_to.translation());
    std::vector<StatedPose> views;
    for (const Reduced* r : links) views.push_back(state_pose({in_world(*r)}, T_to_cam));
    return views_that_hold(views, expected_pose(first, T_to_cam), known,
                           {kMistaken.position * scales_[first.from], kMistaken.rotation});
  }
  // In a scene that repeats itself one mistake makes others more probable.
  void drop_mistaken_places(const std::vector<Reduced>& links, PlacedEpochs* placed) const {
    std::map<std::pair<size_t, size_t>, std::vector<const Reduced*>> by_epochs;
    for (const Reduced& r : links)
      if (r.from < r.to && !is_seen_again(r)) by_epochs[{r.from, r.to}].push_back(&r);
    MistakenViews known = kMistakenViews;
    for (const auto& [epochs, of_these] : by_epochs) {
      const std::vector<bool> holds = hold(of_these, known);
      for (size_t k = 0; k < holds.size(); ++k) {
        ++(holds[k] ? known.right : known.mistaken);
        if (!holds[k]) placed->unused.push_back(of_these[k]->id);
      }
    }
  }

  // The nodes have the unit of the world.
  void find_places(PlacedEpochs* placed) const {
    const std::vector<Reduced> links = links_of_places(constraints_, *placed);
    drop_mistaken_places(links, placed);
    MapGraph graph;
    const Sim3& T_run_first = epochs_[0].place.T_world_map;
    for (size_t i = 1; i < epochs_.size(); ++i) {
      const Sim3 guess = T_run_first.inverse() * epochs_[i].place.T_world_map;
      graph.add_node(node(i), {1, guess.rigid});
    }
    for (size_t i = 1; i < epochs_.size(); ++i)
      if (const auto c = join_of_place(i)) graph.add(in_world(i, *c));
    std::map<int, int> id_of;
    for (const Reduced& r : links)
      if (!placed->is_unused(r.id)) {
        const int number = graph.add(in_world(r, kMistaken));
        if (!is_seen_again(r)) id_of[number] = r.id;
      }
    const GraphSolution found = graph.solve(MapGraph::Sigmas::kNone);
    for (const int failed : found.failed)
      if (const auto c = id_of.find(failed); c != id_of.end()) placed->unused.push_back(c->second);
    for (size_t i = 1; i < epochs_.size(); ++i)
      placed->epochs[i].T_world_map =
          T_run_first * Sim3{scales_[i], found.nodes.at(node(i)).T_world_node.rigid};
  }

  bool is_spanned(size_t i) const {
    return std::any_of(constraints_.begin(), constraints_.end(), [&](const Reduced& r) {
      return std::min(r.from, r.to) < i && std::max(r.from, r.to) >= i;
    });
  }
  // Nothing but continuity relates what lies before such a doubt to what lies after it.
  bool is_bridge(size_t i) const { return continues(i) && !is_spanned(i); }
  // It may have failed unseen.
  void add_unknown_variance(PlacedEpochs* placed) const {
    double unseen = 0, announced = 0;  // variances
    for (size_t i = 1; i < epochs_.size(); ++i) {
      double& sigma = placed->epochs[i].scale_sigma;
      if (is_bridge(i) && epochs_[i].is_doubted) unseen += kLostProbability * squared(kUnknownScale);
      if (constraints_.empty()) announced += squared(epochs_[i].unit_sigma);
      if (constraints_.empty() && !continues(i)) announced += squared(epochs_[i].place.scale_sigma);
      sigma = std::sqrt((constraints_.empty() ? announced : squared(sigma)) + unseen);
    }
  }

  void place_between(size_t i, PlacedEpochs* placed) const {
    if (!courses_[i]) return;
    const std::vector<Sim3> places =
        courses_[i]->place(placed->epochs[i - 1].T_world_map, placed->epochs[i].T_world_map);
    for (size_t k = 1; k + 1 < places.size(); ++k) placed->own[courses_[i]->keyframes()[k].id] = places[k];
  }

  const std::vector<Epoch>& epochs_;
  const RunSoFar& run_;
  std::vector<std::optional<DoubtfulCourse>> courses_;  // before each epoch
  std::vector<Reduced> constraints_;
  std::set<size_t> lost_;       // epochs whose unit is not that of the one before
  std::vector<double> scales_;  // of the epochs in the world
};

PlacedEpochs Epochs::solve(const RunSoFar& run) const {
  return epochs_.empty() ? PlacedEpochs() : Solver(*this, run).solve();
}

PlacedEpochs Epochs::solve_keyframes(const RunSoFar& run, const std::vector<KeyframeInMap>& keyframes) const {
  PlacedEpochs placed = solve(run);
  if (!constraints_.empty()) placed.newest_constraint = constraints_.rbegin()->first;
  const bool is_place_seen_again = std::any_of(constraints_.begin(), constraints_.end(), [&](const auto& c) {
    return relates_keyframes(c.second, run);
  });
  if (is_place_seen_again) place_keyframes(constraints_, keyframes, run, &placed);
  return placed;
}

}  // namespace edgevo
