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
                             const ScaleOfView& scale_of) {
  ScaleAnswer answer;
  answer.frame_index = frame_index;
  answer.now = view;
  const Candidates open{open_.before(), true};
  if (health == IntegrityMonitor::Integrity::kRecovered) {
    // By a view of the unit that is looked for since an earlier doubt, or else by that before this one.
    std::vector<Candidates> candidates;
    if (open_.is_open()) candidates.push_back(open);
    candidates.push_back({before, false});
    answer.ends_doubt = true;
    if (!before.empty()) answer.last_before = before.front();
    begin(std::move(answer), std::move(candidates), scale_of);
  } else if (health == IntegrityMonitor::Integrity::kNominal && is_idle() &&
             open_.is_due(frame_index, view)) {
    begin(std::move(answer), {open}, scale_of);
  }
}

void ScaleComparisons::begin(ScaleAnswer answer, std::vector<Candidates> candidates,
                             const ScaleOfView& scale_of) {
  std::map<const Reference*, double> scales{{answer.now.reference.get(), scale_of(answer.now)}};
  for (const Candidates& c : candidates)
    for (const TrustedReference& v : c.before) scales.emplace(v.reference.get(), scale_of(v));
  worker_.submit([this, answer = std::move(answer), candidates = std::move(candidates),
                  scales = std::move(scales)]() mutable {
    const TraceScope traced("unit of length", answer.frame_index);
    for (const Candidates& c : candidates) {
      answer.compared.push_back(
          {evaluate_doubt(pinhole_, c.before, answer.now,
                          [&](const TrustedReference& v) { return scales.at(v.reference.get()); }),
           c.before, c.is_open});
      if (answer.found().linked) break;
    }
    answers_.push(std::move(answer));
  });
}

std::optional<ScaleAnswer> ScaleComparisons::take(IntegrityMonitor::Integrity health,
                                                  const TrustedReference& view) {
  std::optional<ScaleAnswer> answer = answers_.pop_within(std::chrono::seconds(0));
  if (!answer) return std::nullopt;
  for (const ComparedScale& c : answer->compared)
    if (c.found.unit) open_.note(answer->frame_index, c.before, answer->now, *c.found.unit);
  answer->confirms_map = health != IntegrityMonitor::Integrity::kInDoubt &&
                         answer->now.segment == view.segment && answer->found().confirms_map;
  return answer;
}

// An answer that has not been taken may end what another comparison would look for.
bool ScaleComparisons::is_idle() const { return worker_.is_idle() && answers_.size() == 0; }

}  // namespace edgevo
