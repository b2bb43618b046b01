// SPDX-License-Identifier: BSD-3-Clause
#include "course_guess.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "edgevo/map/scale_cost.h"

namespace edgevo {
namespace {

// Knots to each side whose measurements are candidates: two and a half intervals. Of those within ten, which
// a slip may last, some.
constexpr size_t kCandidateKnots = 5, kFarKnots = 20, kFarCandidates = 8;
// Wheels slip over some 100 m of ice or gravel: five knots.
constexpr double kFaultEnds = 0.2;

// Measurements of a knot, by source; null: the source measures nothing there.
using AtKnot = std::vector<const KnotMeasurement*>;

struct State {
  double log_scale = 0;
  unsigned faults = 0;  // a bit for each source
  double cost = 0;
  size_t before = 0;

  bool is_fault(size_t source) const { return (faults >> source) & 1u; }
};

double residual(const State& state, const KnotMeasurement& m) {
  return state.log_scale - std::log(m.constraint.T_from_to.scale);
}

class Course {
 public:
  Course(const std::vector<KnotMeasurement>& measurements,
         const std::vector<std::optional<Constraint>>& links, double drift_variance)
      : measurements_(measurements), links_(links), drift_variance_(drift_variance) {
    size_t sources = 0;
    for (const KnotMeasurement& m : measurements)
      sources = std::max(sources, m.source + 1), any_slips_ |= m.slips;
    at_.assign(links.size(), AtKnot(sources, nullptr));
    for (const KnotMeasurement& m : measurements) at_[m.knot][m.source] = &m;
  }

  CourseGuess solve() const {
    std::vector<std::vector<State>> states{{State()}};
    for (size_t k = 0; k < links_.size(); ++k) {
      std::vector<State> here = states_of(k);
      for (State& state : here) reach(k, states.back(), &state);
      states.push_back(std::move(here));
    }
    return followed_back(states);
  }

 private:
  std::vector<double> measured_within(size_t knot, size_t reach) const {
    std::vector<double> logs;
    for (size_t k = knot - std::min(knot, reach); k < std::min(knot + reach + 1, at_.size()); ++k)
      for (const KnotMeasurement* m : at_[k])
        if (m) logs.push_back(std::log(m->constraint.T_from_to.scale));
    return logs;
  }

  std::vector<double> candidates(size_t knot) const {
    std::vector<double> logs = measured_within(knot, kCandidateKnots), far = measured_within(knot, kFarKnots);
    std::sort(far.begin(), far.end());
    const size_t some = any_slips_ && far.size() > logs.size() ? kFarCandidates : 0;
    for (size_t i = 0; i < some; ++i) logs.push_back(far[i * (far.size() - 1) / (some - 1)]);
    if (logs.empty()) logs.push_back(std::log(measurements_.front().constraint.T_from_to.scale));
    return logs;
  }

  std::vector<State> states_of(size_t knot) const {
    unsigned measuring = 0;
    for (size_t s = 0; s < at_[knot].size(); ++s) measuring |= at_[knot][s] ? 1u << s : 0u;
    std::vector<State> states;
    for (const double log_scale : candidates(knot))
      for (unsigned faults = 0; faults <= measuring; ++faults)
        if ((faults & ~measuring) == 0) states.push_back({log_scale, faults, 0, 0});
    return states;
  }

  // From the state of the knot before that costs least.
  void reach(size_t knot, const std::vector<State>& before, State* state) const {
    state->cost = std::numeric_limits<double>::infinity();
    for (size_t j = 0; j < before.size(); ++j) {
      double cost = before[j].cost;
      if (links_[knot]) cost += scale_cost(*links_[knot], state->log_scale - before[j].log_scale);
      for (size_t s = 0; s < at_[knot].size() && cost < state->cost; ++s)
        if (at_[knot][s])
          cost += cost_of(*at_[knot][s], knot > 0 ? at_[knot - 1][s] : nullptr, *state, before[j]);
      if (cost < state->cost) state->cost = cost, state->before = j;
    }
  }

  // Of a measurement that is right, at fault by anything, or still at fault by as much as before.
  double cost_of(const KnotMeasurement& m, const KnotMeasurement* m_before, const State& state,
                 const State& before) const {
    const double r = residual(state, m), variance = m.constraint.covariance(6, 6);
    const bool may_go_on = m.slips && m_before && before.is_fault(m.source);
    if (!state.is_fault(m.source)) return r * r / variance + (may_go_on ? -2 * std::log(kFaultEnds) : 0);
    const double p = m.constraint.failure->probability, broad = m.constraint.failure->covariance(6, 6);
    const double begins = r * r / broad + std::log(broad / variance) + 2 * std::log((1 - p) / p);
    if (!may_go_on) return begins;
    const double change = r - residual(before, *m_before),
                 measured_variance = variance + m_before->constraint.covariance(6, 6);
    // Meanwhile the scale drifts, which nothing measures: by the most probable value.
    const double goes_on = change * change / (measured_variance + drift_variance_) +
                           std::log(measured_variance / variance) - 2 * std::log(1 - kFaultEnds);
    return std::min(begins, goes_on);
  }

  CourseGuess followed_back(const std::vector<std::vector<State>>& states) const {
    CourseGuess guess{std::vector<double>(links_.size()), std::vector<bool>(measurements_.size())};
    const auto least = std::min_element(states.back().begin(), states.back().end(),
                                        [](const State& a, const State& b) { return a.cost < b.cost; });
    size_t at = size_t(least - states.back().begin());
    for (size_t k = links_.size(); k-- > 0;) {
      const State& state = states[k + 1][at];
      guess.scales[k] = std::exp(state.log_scale);
      for (size_t s = 0; s < at_[k].size(); ++s)
        if (at_[k][s]) guess.is_fault[size_t(at_[k][s] - measurements_.data())] = state.is_fault(s);
      at = state.before;
    }
    return guess;
  }

  const std::vector<KnotMeasurement>& measurements_;
  const std::vector<std::optional<Constraint>>& links_;
  const double drift_variance_;
  bool any_slips_ = false;
  std::vector<AtKnot> at_;
};

}  // namespace

CourseGuess guess_course(const std::vector<KnotMeasurement>& measurements,
                         const std::vector<std::optional<Constraint>>& links, double drift_variance) {
  return Course(measurements, links, drift_variance).solve();
}

}  // namespace edgevo
