// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <memory>

#include "edgevo/core/error.h"
#include "growing_file.h"
#include "record_file.h"
#include "recovery_format.h"
#include "recovery_values.h"

namespace edgevo {
namespace {

void check_is_interrupted(const std::string& folder) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(recovery_log_path(folder), ignored))
    throw InputError(folder, "holds no interrupted run (there is no " + std::string(kRecoveryLog) + ")",
                     "give the folder of a run that was killed; `edgevo map` makes maps of one that ended");
  if (GrowingFile::is_growing(recovery_log_path(folder)))
    throw InputError(folder, "its run is still in progress", "wait for it, or end it with Ctrl-C");
}

RecoveryHeader read_first_record(RecordFile* file, const std::string& path) {
  RecoveryRecord record;
  if (file->next(&record) && record.kind == kHeaderRecord)
    if (const auto header = read_header(record.content)) return *header;
  if (file->is_of_another_version())
    throw InputError(path, "was written by another version of edgevo",
                     "finish the run with that version, or run the sequence again with --force");
  throw InputError(path, "is incomplete or no recovery log", "run the sequence again with --force");
}

}  // namespace

struct RecoveryLogReader::Impl {
  explicit Impl(const std::string& folder)
      : log(recovery_log_path(folder)),
        window((std::filesystem::path(folder) / kRunWindow).string()),
        header(read_first_record(&log, recovery_log_path(folder))) {}

  std::optional<MapEvent> next() {
    RecoveryRecord record;
    std::optional<MapEvent> event;
    if (log_goes_on && log.next(&record)) event = read_event(record.kind, record.content);
    log_goes_on = event.has_value();
    if (!event && window.next(&record)) event = read_event(record.kind, record.content);
    return event;
  }

  std::set<int> frames_beyond_damage() {
    std::set<int> frames;
    for (const RecoveryRecord& record : log.beyond_damage()) {
      const std::optional<MapEvent> event = read_event(record.kind, record.content);
      if (const auto* frame = event ? std::get_if<FrameAnchored>(&*event) : nullptr)
        frames.insert(frame->frame.index);
    }
    return frames;
  }

  RecordFile log, window;
  RecoveryHeader header;
  bool log_goes_on = true;
};

RecoveryLogReader::RecoveryLogReader(const std::string& folder) {
  check_is_interrupted(folder);
  impl_ = std::make_unique<Impl>(folder);
}

RecoveryLogReader::~RecoveryLogReader() = default;

const RecoveryHeader& RecoveryLogReader::header() const { return impl_->header; }
std::optional<MapEvent> RecoveryLogReader::next() { return impl_->next(); }
std::set<int> RecoveryLogReader::frames_beyond_damage() { return impl_->frames_beyond_damage(); }

}  // namespace edgevo
