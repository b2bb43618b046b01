// SPDX-License-Identifier: BSD-3-Clause
#include "unit_guess.h"

#include <algorithm>
#include <cmath>

#include "edgevo/map/scale_cost.h"

namespace edgevo {
namespace {

double residual(const Constraint& c, double log_scale) { return log_scale - std::log(c.T_from_to.scale); }

// The epochs that get other units: those in [begin, end).
struct Moved {
  size_t begin, end;
  bool contains(size_t epoch) const { return begin <= epoch && epoch < end; }
  bool changes(const UnitRelation& r) const { return contains(r.from) != contains(r.to); }
};

class Guess {
 public:
  Guess(size_t epochs, const std::vector<UnitRelation>& relations) : units_(epochs, 0.0) {
    // By where they can be changed: those of each epoch, and those that span the beginning of each.
    of_.resize(epochs), across_.resize(epochs);
    for (const UnitRelation& r : relations) {
      const auto [first, last] = std::minmax(r.from, r.to);
      of_[first].push_back(&r), of_[last].push_back(&r);
      for (size_t i = first + 1; i <= last; ++i) across_[i].push_back(&r);
    }
  }

  std::vector<double> find() {
    // Each round decides at least one epoch; rounding must not keep it going.
    bool improved = true;
    for (size_t round = 0; improved && round <= units_.size(); ++round) {
      improved = false;
      for (size_t i = 1; i < units_.size(); ++i) {
        improved |= improve({i, units_.size()}, across_[i]);
        improved |= improve({i, i + 1}, of_[i]);
      }
    }
    return units_;
  }

 private:
  using Relations = std::vector<const UnitRelation*>;

  double log_scale(const UnitRelation& r) const { return units_[r.to] - units_[r.from]; }
  double cost_after(const Relations& relations, const Moved& moved, double change) const {
    double cost = 0;
    for (const UnitRelation* r : relations) {
      const double sign = moved.changes(*r) ? (moved.contains(r->to) ? 1 : -1) : 0;
      cost += scale_cost(r->constraint, residual(r->constraint, log_scale(*r) + sign * change));
    }
    return cost;
  }

  // By the change with which one of the relations holds that costs least in all.
  bool improve(const Moved& moved, const Relations& relations) {
    // Less is rounding: the minimum that is nearest is found by the graph.
    constexpr double kLeastGain = 1e-6;
    double least = cost_after(relations, moved, 0) - kLeastGain, best = 0;
    for (const UnitRelation* r : relations) {
      if (!moved.changes(*r)) continue;
      const double off = -residual(r->constraint, log_scale(*r));
      const double change = moved.contains(r->to) ? off : -off;
      const double cost = cost_after(relations, moved, change);
      if (cost < least) least = cost, best = change;
    }
    for (size_t i = moved.begin; i < moved.end; ++i) units_[i] += best;
    return best != 0;
  }

  std::vector<double> units_;
  std::vector<Relations> of_, across_;
};

}  // namespace

std::vector<double> guess_units(size_t epochs, const std::vector<UnitRelation>& relations) {
  return Guess(epochs, relations).find();
}

}  // namespace edgevo
