// SPDX-License-Identifier: BSD-3-Clause
// Evidence of rendered runs, recorded once (evidence/*.csv), makes the p_right and the states recorded with
// it: no weight, ramp or threshold moves by accident. After one that was meant to move:
//
//   EDGEVO_RECORD=1 build/release/bin/test_confidence --gtest_filter='*RecordedEvidence*'
//
// writes what now comes out of the same evidence.
#include "unit/confidence/recorded_evidence.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "edgevo/core/doubtful_frame.h"
#include "edgevo/core/output_file.h"

namespace edgevo {
namespace {

using test::EvidenceRow;
using test::Outcome;

const std::vector<std::string> kRecorded{"street",      "corridor",  "desk",         "rotation",
                                         "office_walk", "open_land", "turn_in_place"};

std::string table_of(const std::string& name) {
  return EDGEVO_SOURCE_DIR "/tests/unit/confidence/evidence/" + name + ".csv";
}

// The table with what comes out now.
void record_outcomes(const std::string& path) {
  std::vector<EvidenceRow> rows = test::read_evidence(path);
  test::EvidenceReplay replay;
  for (EvidenceRow& row : rows) row.outcome = replay.add(row.frame);
  OutputFile file(path);
  file.write(test::to_text(rows));
  file.close();
}

constexpr const char* kRemedyOfRecord =
    "If that was meant: fit p_right again (share/doc/numbers.md), then\n"
    "  EDGEVO_RECORD=1 build/release/bin/test_confidence --gtest_filter='*RecordedEvidence*'";

// What differs from the record, empty if nothing does.
std::string differences(const Outcome& now, const Outcome& recorded) {
  std::string text;
  const auto add = [&](const std::string& what, double is, double was) {
    text += what + " is " + std::to_string(is) + ", was " + std::to_string(was) + "; ";
  };
  for (size_t k = 0; k < kConsistencyTests; ++k)
    if (!test::is_same_doubt(now.doubts[k], recorded.doubts[k]))
      add(std::string("doubt ") + test::name_of_doubt(k), now.doubts[k], recorded.doubts[k]);
  if (!test::is_same_p(now.p_right, recorded.p_right)) add("p_right", now.p_right, recorded.p_right);
  if (now.state != recorded.state)
    text += std::string("state is ") + std::string(to_string(now.state)) + ", was " +
            std::string(to_string(recorded.state));
  return text;
}

class RecordedEvidence : public ::testing::TestWithParam<std::string> {};

TEST_P(RecordedEvidence, MakesTheRecordedDoubtsTrustAndStatesInEveryDigit) {
  const std::string path = table_of(GetParam());
  if (std::getenv("EDGEVO_RECORD")) record_outcomes(path);
  const std::vector<EvidenceRow> rows = test::read_evidence(path);
  test::EvidenceReplay replay;
  int others = 0;
  for (size_t i = 0; i < rows.size(); ++i) {
    const std::optional<Outcome> now = replay.add(rows[i].frame);
    if (!now) continue;
    const std::string text = differences(*now, *rows[i].outcome);
    others += !text.empty();
    if (others <= 3) {
      EXPECT_EQ(text, "") << GetParam() << ".csv:" << i + 2;
    }
  }
  EXPECT_EQ(others, 0) << "frames of " << GetParam() << ": weights, ramps or thresholds have changed.\n"
                       << kRemedyOfRecord;
}

INSTANTIATE_TEST_SUITE_P(Run, RecordedEvidence, ::testing::ValuesIn(kRecorded),
                         [](const auto& run) { return run.param; });

// Of right runs, as if their witnesses went one after the other: the corners from a quarter of the run on,
// what the image says of the pose from a third on, by a seventh of its standard deviation more in each
// frame, as in a blur. The largest fall is 0.19 a frame; a veto takes all of it.
TEST(RecordOfEvidence, OfARightRunFallsSmoothlyAsItsWitnessesGo) {
  for (const char* name : {"street", "corridor"}) {
    const std::vector<EvidenceRow> rows = test::read_evidence(table_of(name));
    test::EvidenceReplay whole, without;
    double before = 1, vaguer = 1, all = 1;
    for (size_t i = 0; i < rows.size(); ++i) {
      test::RecordedFrame frame = rows[i].frame;
      if (const std::optional<Outcome> o = whole.add(frame)) all = o->p_right;
      if (4 * i > rows.size()) frame.evidence.corners.reset();
      if (3 * i > rows.size()) vaguer *= 1.15;
      for (double& sigma : frame.evidence.pose_sigmas) sigma *= vaguer;
      const std::optional<Outcome> now = without.add(frame);
      if (!now) continue;
      if (vaguer == 1) {
        EXPECT_GT(now->p_right, all - 0.1)
            << name << ".csv:" << i + 2 << ": no corners speak against nothing";
      }
      EXPECT_GT(now->p_right, before - 0.25) << name << ".csv:" << i + 2;
      before = now->p_right;
    }
    EXPECT_GT(all, 0.9) << name;
    EXPECT_LT(before, kDoubtfulBelow) << name;
  }
}

// A record of sure frames alone would notice little.
TEST(RecordOfEvidence, HasSureAndDoubtfulFramesAndEveryDoubt) {
  int sure = 0, doubtful = 0, between = 0;
  Inconsistencies largest, least;
  largest.fill(-100), least.fill(100);
  for (const std::string& name : kRecorded)
    for (const EvidenceRow& row : test::read_evidence(table_of(name))) {
      if (!row.outcome) continue;
      const double p = row.outcome->p_right;
      sure += int(p > 0.9), doubtful += int(p < kDoubtfulBelow), between += int(0.11 < p && p < 0.99);
      for (size_t k = 0; k < kConsistencyTests; ++k)
        largest[k] = std::max(largest[k], row.outcome->doubts[k]),
        least[k] = std::min(least[k], row.outcome->doubts[k]);
    }
  EXPECT_GT(sure, 100);
  EXPECT_GT(doubtful, 20);
  EXPECT_GT(between, 100) << "where the curve is steep";
  for (size_t k = 0; k < kConsistencyTests; ++k)
    EXPECT_GT(largest[k], least[k] + 0.5) << test::name_of_doubt(k);
}

}  // namespace
}  // namespace edgevo
