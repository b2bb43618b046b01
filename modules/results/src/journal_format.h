#pragma once
// How a run's journal is laid out: a first line, then records of kind, size, content and checksum.
#include <cstdint>
#include <string>
#include <string_view>

#include "edgevo/results/run_journal.h"

namespace edgevo {

constexpr std::string_view kJournalFirstLine = "edgevo run journal 1\n";  // another number for another layout

enum class JournalKind : uint8_t {
  kHeader,           ///< once, the first
  kFrame,            ///< as it came
  kLatePose,         ///< a frame again, which has got its pose
  kCamera,           ///< what self-calibration says from here on
  kKeyframe,         ///< one more has settled
  kRevisedKeyframe,  ///< after a correction of the camera: one of those so far again, in their order
  kRevised           ///< the revised ones are complete, and stand for those before
};

/// Continues the checksum `sum` (0: begins one).
uint32_t journal_checksum(uint32_t sum, std::string_view bytes);

/// One record with all that belongs to it.
std::string journal_record(JournalKind kind, const std::string& content);

std::string journal_path(const std::string& folder);

}  // namespace edgevo
