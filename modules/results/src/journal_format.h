#pragma once
// How a run's journal is laid out: a first line, then records of kind, size, content and checksum.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "edgevo/results/run_journal.h"

namespace edgevo {

constexpr std::string_view kJournalFirstLine = "edgevo run journal 1\n";  // another number for another layout
constexpr const char* kNewWindow = "unfinished_window.bin.new";           // on its way to be kRunWindow

enum class JournalKind : uint8_t {
  kHeader,           ///< once, the first
  kFrame,            ///< as it came
  kLatePose,         ///< a frame again, which has got its pose
  kCamera,           ///< what self-calibration says from here on
  kKeyframe,         ///< one more has settled
  kRevisedKeyframe,  ///< after a correction of the camera: one of those so far again, in their order
  kRevised,          ///< the revised ones are complete, and stand for those before
  kWindow            ///< in the file of the window only: revisions so far, and its keyframes
};

/// Continues the checksum `sum` (0: begins one).
uint32_t journal_checksum(uint32_t sum, std::string_view bytes);

/// One record with all that belongs to it.
std::string journal_record(JournalKind kind, const std::string& content);

std::string journal_path(const std::string& folder);
/// The files of an unfinished run in its folder: the journal is the last.
const std::vector<std::string>& journal_files();
/// Takes them away.
void remove_journal(const std::string& folder);

}  // namespace edgevo
