// SPDX-License-Identifier: BSD-3-Clause
#include "scale_course.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "course_guess.h"
#include "edgevo/map/map_graph.h"
#include "edgevo/map/scale_cost.h"

namespace edgevo {
namespace {

constexpr double kKnotsPerInterval = 2;
// Of the logarithm of the scale over one interval: 0.6 to 1.6 % over 40 m on three KITTI drives and one of
// Karlsruhe, by their ground truth.
constexpr double kDriftSigma = 0.015;
// A unit that changes by more than drift between two knots is nearly always seen, as a doubt.
constexpr double kUnitChangeProbability = 0.001;
// Of an interval of a source: wheels slip, or a receiver drifts, in one of twenty.
constexpr double kFaultProbability = 0.05;
// Relative: exact tracks are of tests, and an exact scale cannot fail.
constexpr double kLeastSigma = 1e-6;
// Of the logarithm of the lengths then: some tens of percent.
constexpr double kFaultSigma = 0.3;

struct Knot {
  size_t path = 0;
  double distance = 0, zone_begin = 0, zone_end = 0;
  double begin = 0, end = 0;  // of its interval
  ScaleEstimate scale{1, 0, 0};
};

// Of the logarithm of the scale from one knot to the next.
double drift_variance() { return kDriftSigma * kDriftSigma / kKnotsPerInterval; }

double length_of(const Path& path) { return path.back().distance - path.front().distance; }

// What is measured `times` over counts so often: its variance is multiplied by it, and what a failure costs
// is divided by it, since all fail at once. With p the probability of a failure and s, f the standard
// deviations without and with it, it costs 2 ln((1 - p) / p) + 2 ln(f / s).
double probability_of_share(double probability, double sigma, double times) {
  const double odds = (1 - probability) / probability, widths = std::hypot(sigma, kFaultSigma) / sigma,
               shared_sigma = std::sqrt(times) * sigma,
               shared_widths = std::hypot(shared_sigma, kFaultSigma) / shared_sigma;
  return 1 / (1 + std::pow(odds * widths, 1 / times) / shared_widths);
}

// The scale alone, which can fail to be right by kFaultSigma more.
Constraint of_scale(NodeId from, NodeId to, double scale, double sigma, double fails, double times,
                    ConstraintKind kind) {
  const double shared_sigma = std::sqrt(times) * sigma;
  Constraint c = scale_constraint(kind, from, to, scale, shared_sigma);
  c.failure = {probability_of_share(fails, sigma, times),
               covariance_of_scale(std::hypot(shared_sigma, kFaultSigma))};
  return c;
}

// Without a choice: in the mode that costs less.
Constraint in_better_mode(double residual, Constraint c) {
  if (!c.failure) return c;
  const double square = residual * residual;
  if (scale_cost(c, residual) < square / c.covariance(6, 6)) c.covariance = c.failure->covariance;
  c.failure.reset();
  return c;
}

class CourseGraph {
 public:
  CourseGraph(const std::vector<MeasuredPath>& paths, const ScaleParams& params, CourseModes modes)
      : paths_(paths), params_(params), modes_(modes) {
    place_knots();
    measure();
  }

  ScaleCourse solve();

 private:
  double interval_units(size_t path) const;
  void place_knots();
  void measure();
  std::vector<Constraint> constraints_of_measurements() const;
  std::vector<std::optional<Constraint>> links() const;
  CourseGuess guess() const;
  void fail(const std::vector<bool>& is_fault);
  void fix_modes(const std::vector<double>& guess);
  void add_nodes(const std::vector<double>& guess, MapGraph* graph) const;
  void add_constraints(MapGraph* graph);
  void adopt(const GraphSolution& solution);
  void fill_unlinked();
  std::vector<ScaleEstimate> along(size_t path) const;

  // The camera's height and the like are nodes of the paths' graph, too.
  NodeId node(size_t knot) const { return NodeId::epoch(int(knots_[knot].path), int(knot)); }
  NodeId node_of_source(size_t source) const { return NodeId::epoch(int(paths_.size()), int(source)); }
  bool has_common(size_t source) const {
    return common_sigma(paths_.front().sources[source].source, params_) > 0;
  }

  bool slips(size_t source) const {
    return paths_.front().sources[source].source.kind == ScaleSource::Kind::kOdometry;
  }

  const std::vector<MeasuredPath>& paths_;
  const ScaleParams& params_;
  const CourseModes modes_;
  std::vector<Knot> knots_;
  std::vector<double> intervals_;  // by path, units
  std::vector<IntervalMeasurement> measurements_;
  std::vector<size_t> knot_of_;                   // by measurement
  std::vector<Constraint> measured_;              // by measurement
  std::vector<std::optional<Constraint>> links_;  // of each knot to the one before
  std::map<int, size_t> measurement_of_;          // by constraint
  std::map<int, size_t> source_of_;               // by constraint of what its measurements have in common
};

// The whole path if no scale is known or it is shorter.
double CourseGraph::interval_units(size_t path) const {
  const double whole = length_of(*paths_[path].path);
  std::vector<double> factors;
  for (const SourceSamples& samples : paths_[path].sources)
    if (const auto factor = rough_scale(samples, params_)) factors.push_back(*factor);
  if (factors.empty()) return whole;
  // The smaller of two: a source that jumps all the time measures too much.
  const auto middle = factors.begin() + std::ptrdiff_t((factors.size() - 1) / 2);
  std::nth_element(factors.begin(), middle, factors.end());
  return std::min(params_.interval / *middle, whole);
}

void CourseGraph::place_knots() {
  for (size_t p = 0; p < paths_.size(); ++p) {
    const double start = paths_[p].path->front().distance, whole = length_of(*paths_[p].path);
    const double length = interval_units(p);
    intervals_.push_back(length);
    const int steps = length > 0 ? int(std::ceil(kKnotsPerInterval * (whole - length) / length)) : 0;
    for (int i = 0; i <= steps; ++i) {
      const double begin = start + (steps > 0 ? (whole - length) * i / steps : 0);
      const double half_step = steps > 0 ? (whole - length) / steps / 2 : whole;
      Knot knot;
      knot.path = p;
      knot.begin = begin, knot.end = begin + length;
      knot.distance = begin + length / 2;
      knot.zone_begin = i == 0 ? start : knot.distance - half_step;
      knot.zone_end = i == steps ? start + whole : knot.distance + half_step;
      knots_.push_back(knot);
    }
  }
}

void CourseGraph::measure() {
  for (size_t k = 0; k < knots_.size(); ++k) {
    const Knot& knot = knots_[k];
    for (size_t s = 0; s < paths_[knot.path].sources.size(); ++s)
      if (auto fit = fit_interval(paths_[knot.path].sources[s], knot.begin, knot.end, params_)) {
        measurements_.push_back({knot.path, s, knot.begin, knot.end, knot.zone_begin, knot.zone_end,
                                 std::move(*fit), true, 0, 0});
        knot_of_.push_back(k);
      }
  }
}

std::vector<Constraint> CourseGraph::constraints_of_measurements() const {
  std::vector<double> counted(paths_.size(), 0.0);  // how often, in lengths of the path
  for (const Knot& knot : knots_) counted[knot.path] += knot.end - knot.begin;
  std::vector<Constraint> constraints;
  for (size_t i = 0; i < measurements_.size(); ++i) {
    const IntervalMeasurement& m = measurements_[i];
    const double whole = length_of(*paths_[m.path].path);
    const double times = whole > 0 ? std::max(1.0, counted[m.path] / whole) : 1;
    const bool common = has_common(m.source);
    constraints.push_back(of_scale(common ? node_of_source(m.source) : NodeId::world(), node(knot_of_[i]),
                                   m.fit.scale.factor, std::max(m.fit.scale.sigma, kLeastSigma),
                                   kFaultProbability, times,
                                   common ? ConstraintKind::kGround : ConstraintKind::kMetric));
  }
  return constraints;
}

std::vector<std::optional<Constraint>> CourseGraph::links() const {
  std::vector<std::optional<Constraint>> links(knots_.size());
  for (size_t k = 1; k < knots_.size(); ++k) {
    double link_sigma = 0;
    if (knots_[k].path != knots_[k - 1].path) {
      if (!paths_[knots_[k].path].link_sigma) continue;
      link_sigma = *paths_[knots_[k].path].link_sigma;
    }
    const double sigma = std::hypot(std::sqrt(drift_variance()), link_sigma);
    links[k] =
        of_scale(node(k - 1), node(k), 1, sigma, kUnitChangeProbability, 1, ConstraintKind::kNeighbour);
  }
  return links;
}

CourseGuess CourseGraph::guess() const {
  std::vector<KnotMeasurement> measured;
  for (size_t i = 0; i < measured_.size(); ++i)
    measured.push_back({knot_of_[i], measurements_[i].source, measured_[i], slips(measurements_[i].source)});
  return guess_course(measured, links_, drift_variance());
}

// Wheels that slip do so: the graph knows nothing of faults that go on.
void CourseGraph::fail(const std::vector<bool>& is_fault) {
  for (size_t i = 0; i < measured_.size(); ++i) {
    if (!is_fault[i] || !slips(measurements_[i].source)) continue;
    measured_[i].covariance = measured_[i].failure->covariance;
    measured_[i].failure.reset();
    measurements_[i].holds = false;
  }
}

void CourseGraph::fix_modes(const std::vector<double>& guess) {
  for (size_t i = 0; i < measured_.size(); ++i)
    measured_[i] = in_better_mode(std::log(guess[knot_of_[i]] / measured_[i].T_from_to.scale), measured_[i]);
  for (size_t k = 1; k < links_.size(); ++k)
    if (links_[k]) links_[k] = in_better_mode(std::log(guess[k] / guess[k - 1]), *links_[k]);
}

void CourseGraph::add_nodes(const std::vector<double>& guess, MapGraph* graph) const {
  for (size_t k = 0; k < knots_.size(); ++k) graph->add_node(node(k), Sim3{guess[k], SE3()});
  for (size_t s = 0; s < paths_.front().sources.size(); ++s)
    if (has_common(s)) graph->add_node(node_of_source(s), Sim3());
}

void CourseGraph::add_constraints(MapGraph* graph) {
  for (size_t s = 0; s < paths_.front().sources.size(); ++s)
    if (has_common(s))
      source_of_[graph->add(of_scale(NodeId::world(), node_of_source(s), 1,
                                     common_sigma(paths_.front().sources[s].source, params_),
                                     kFaultProbability, 1, ConstraintKind::kMetric))] = s;
  for (size_t i = 0; i < measured_.size(); ++i) measurement_of_[graph->add(measured_[i])] = i;
  for (const std::optional<Constraint>& link : links_)
    if (link) graph->add(*link);
}

void CourseGraph::adopt(const GraphSolution& solution) {
  for (size_t k = 0; k < knots_.size(); ++k) {
    const NodeSolution& s = solution.nodes.at(node(k));
    knots_[k].scale.factor = s.T_world_node.scale, knots_[k].scale.sigma = s.log_scale_sigma;
  }
  for (const int id : solution.failed) {
    if (const auto at = measurement_of_.find(id); at != measurement_of_.end())
      measurements_[at->second].holds = false;
    if (const auto at = source_of_.find(id); at != source_of_.end())
      for (IntervalMeasurement& m : measurements_) m.holds &= m.source != at->second;
  }
  for (size_t i = 0; i < measurements_.size(); ++i) {
    IntervalMeasurement& m = measurements_[i];
    ScaleEstimate& knot = knots_[knot_of_[i]].scale;
    m.log_excess = std::log(m.fit.scale.factor / knot.factor);
    m.log_excess_sigma = std::hypot(m.fit.scale.sigma, knot.sigma);
    if (m.holds) knot.samples += m.fit.scale.samples;
  }
}

// Knots that nothing measures or links have the scale of the nearest before them, else after, as uncertain as
// where the unit changed.
void CourseGraph::fill_unlinked() {
  const auto is_known = [](const Knot& knot) { return std::isfinite(knot.scale.sigma); };
  const auto first = std::find_if(knots_.begin(), knots_.end(), is_known);
  ScaleEstimate last = first->scale;
  for (Knot& knot : knots_) {
    if (is_known(knot))
      last = knot.scale;
    else
      knot.scale = {last.factor, std::hypot(last.sigma, kFaultSigma), 0};
  }
}

ScaleEstimate between(const Knot& a, const Knot& b, double distance) {
  const double share = (distance - a.distance) / (b.distance - a.distance);
  const auto mix = [&](double x, double y) { return (1 - share) * x + share * y; };
  return {mix(a.scale.factor, b.scale.factor), mix(a.scale.sigma, b.scale.sigma),
          share < 0.5 ? a.scale.samples : b.scale.samples};
}

std::vector<ScaleEstimate> CourseGraph::along(size_t path) const {
  std::vector<Knot> knots;
  for (const Knot& knot : knots_)
    if (knot.path == path) knots.push_back(knot);
  std::vector<ScaleEstimate> scales;
  for (const PathPose& pose : *paths_[path].path) {
    const auto next = std::upper_bound(knots.begin(), knots.end(), pose.distance,
                                       [](double w, const Knot& k) { return w < k.distance; });
    if (next == knots.begin())
      scales.push_back(knots.front().scale);
    else
      scales.push_back(next == knots.end() ? knots.back().scale : between(*(next - 1), *next, pose.distance));
  }
  return scales;
}

ScaleCourse CourseGraph::solve() {
  ScaleCourse course;
  if (measurements_.empty()) return course;
  measured_ = constraints_of_measurements();
  links_ = links();
  const CourseGuess begin = guess();
  fail(begin.is_fault);
  if (modes_ == CourseModes::kOfGuess) fix_modes(begin.scales);
  MapGraph graph;
  add_nodes(begin.scales, &graph);
  add_constraints(&graph);
  adopt(graph.solve());
  fill_unlinked();
  for (size_t p = 0; p < paths_.size(); ++p) course.of_path.push_back(along(p));
  course.measurements = std::move(measurements_);
  return course;
}

}  // namespace

ScaleCourse solve_scale_course(const std::vector<MeasuredPath>& paths, const ScaleParams& params,
                               CourseModes modes) {
  if (paths.empty()) return {};
  return CourseGraph(paths, params, modes).solve();
}

}  // namespace edgevo
