// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mapping/scale_comparisons.h"

#include <chrono>
#include <map>
#include <utility>

#include "edgevo/core/trace.h"

namespace edgevo {

// None is refused, whatever waits: a doubt ends every twenty frames at most.
ScaleComparisons::ScaleComparisons(const Pinhole& pinhole, bool own_thread)
    : pinhole_(pinhole), answers_(1), worker_({"unit of length", 1, own_thread, true, true}) {}

void ScaleComparisons::begin(IntegrityMonitor::Integrity health, int frame_index,
                             const TrustedReference& view, const std::vector<TrustedReference>& before,
                             const ScaleOf& scale_of) {
  const Candidates open{open_.before(), true, open_.sigma(view.segment)};
  if (health == IntegrityMonitor::Integrity::kRecovered) {
    // By a view of the unit that is looked for since an earlier doubt, or else by that before this one.
    std::vector<Candidates> candidates;
    if (open_.is_open()) candidates.push_back(open);
    candidates.push_back({before, false, UnresolvedScale::kUnknown});
    begin({frame_index, view, true, {}, {}}, std::move(candidates), scale_of);
  } else if (health == IntegrityMonitor::Integrity::kNominal && is_idle() &&
             open_.is_due(frame_index, view)) {
    begin({frame_index, view, false, {}, {}}, {open}, scale_of);
  }
}

void ScaleComparisons::begin(ScaleAnswer answer, std::vector<Candidates> candidates,
                             const ScaleOf& scale_of) {
  std::map<int, double> scales{{answer.now.segment, scale_of(answer.now.segment)}};
  for (const Candidates& c : candidates)
    for (const TrustedReference& v : c.before) scales.emplace(v.segment, scale_of(v.segment));
  worker_.submit([this, answer = std::move(answer), candidates = std::move(candidates),
                  scales = std::move(scales)]() mutable {
    const TraceScope traced("unit of length", answer.frame_index);
    for (const Candidates& c : candidates) {
      answer.found = evaluate_doubt(pinhole_, c.before, answer.now, c.known_to,
                                    [&](int segment) { return scales.at(segment); });
      if (answer.found.unit) answer.compared.push_back({*answer.found.unit, c.before, c.is_open});
      if (answer.is_linked()) break;
    }
    answers_.push(std::move(answer));
  });
}

std::optional<ScaleAnswer> ScaleComparisons::take(IntegrityMonitor::Integrity health,
                                                  const TrustedReference& view) {
  while (std::optional<ScaleAnswer> answer = answers_.pop_within(std::chrono::seconds(0))) {
    if (is_superseded(*answer)) continue;
    const bool holds = health != IntegrityMonitor::Integrity::kInDoubt &&
                       answer->now.segment == view.segment &&
                       answer->now.reference->unit == view.reference->unit;
    if (holds) {
      note(*answer);
      if (answer->found.ended.scale_ratio != 1)
        rescaled_from_ = {answer->now.segment, answer->now.reference->unit};
      return answer;
    }
    note_lost(*answer);
  }
  return std::nullopt;
}

// An answer that has not been taken may end what another comparison would look for.
bool ScaleComparisons::is_idle() const { return worker_.is_idle() && answers_.size() == 0; }

// Whether an answer that was taken before has set back the unit that this one was measured in; mapping may
// not have done so yet.
bool ScaleComparisons::is_superseded(const ScaleAnswer& answer) const {
  return rescaled_from_ == std::pair(answer.now.segment, answer.now.reference->unit);
}

void ScaleComparisons::note(const ScaleAnswer& answer) {
  for (const ComparedScale& c : answer.compared) open_.note(answer.frame_index, c.before, answer.now, c.unit);
}

// As if nothing had linked the map: its unit stays open.
void ScaleComparisons::note_lost(const ScaleAnswer& answer) {
  for (const ComparedScale& c : answer.compared)
    open_.note(answer.frame_index, c.before, answer.now, RelativeScale());
}

}  // namespace edgevo
