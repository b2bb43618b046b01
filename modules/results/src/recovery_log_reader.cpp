// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "bytes.h"
#include "edgevo/core/error.h"
#include "growing_file.h"
#include "recovery_format.h"
#include "recovery_values.h"

namespace edgevo {
namespace {

// Bytes. A keyframe has a thousandth of that.
constexpr uint32_t kLargestRecord = 1u << 28;

struct RecoveryRecord {
  RecoveryKind kind;
  std::string content;
};

// Reads the records of a file one by one, up to the first incomplete one.
class RecordFile {
 public:
  explicit RecordFile(const std::string& path) : file_(std::fopen(path.c_str(), "rb"), &std::fclose) {
    std::string first;
    is_whole_ = file_ && read(kRecoveryFirstLine.size(), &first) && first == kRecoveryFirstLine;
  }
  bool next(RecoveryRecord* record) {
    std::string head, tail;
    if (!is_whole_ || !read(sizeof(RecoveryKind) + sizeof(uint32_t), &head)) return false;
    ByteReader in(head);
    record->kind = in.value<RecoveryKind>();
    const auto size = in.value<uint32_t>();
    is_whole_ =
        size <= kLargestRecord && read(size, &record->content) && read(sizeof(uint32_t), &tail) &&
        ByteReader(tail).value<uint32_t>() == recovery_checksum(recovery_checksum(0, head), record->content);
    return is_whole_;
  }

 private:
  bool read(size_t size, std::string* bytes) {
    bytes->resize(size);
    return std::fread(bytes->data(), 1, size, file_.get()) == size;
  }

  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  bool is_whole_ = false;
};

// Rebuilds the run from its records.
class Rebuilder {
 public:
  explicit Rebuilder(InterruptedRun* interrupted) : interrupted_(*interrupted) {}

  /// Adds a record. Returns false if its content does not match its kind.
  bool take(const RecoveryRecord& record) {
    ByteReader in(record.content);
    switch (record.kind) {
      case RecoveryKind::kHeader:
        read_value(&in, &interrupted_.header);
        break;
      case RecoveryKind::kFrame:
        add_frame(read<FrameRecord>(&in), in.ok());
        break;
      case RecoveryKind::kLatePose:
        set_late_pose(read<FrameRecord>(&in), in.ok());
        break;
      case RecoveryKind::kCamera:
        read_value(&in, &interrupted_.run.camera);
        break;
      case RecoveryKind::kKeyframe:
        add_keyframe(read<KeyframeRecord>(&in), in.ok());
        break;
      case RecoveryKind::kRevisedKeyframe:
        revised_.push_back(read<KeyframeRecord>(&in));
        break;
      case RecoveryKind::kRevised:
        revise();
        break;
      default:
        return false;
    }
    return in.ok();
  }

  /// Adds the keyframes of the window file, except those that have been marginalised since it was written.
  /// Ignores a window from before the last correction of the camera.
  void add_window(const RecoveryRecord& record) {
    ByteReader in(record.content);
    const auto revisions = in.value<uint32_t>();
    std::vector<KeyframeRecord> window;
    read_value(&in, &window);
    if (record.kind != RecoveryKind::kWindow || !in.ok() || revisions != revisions_) return;
    for (KeyframeRecord& keyframe : window)
      if (!is_marginalised(keyframe)) {
        add_keyframe(std::move(keyframe), true);
        ++interrupted_.active;
      }
  }

 private:
  bool is_marginalised(const KeyframeRecord& keyframe) const {
    const auto& marginalised = interrupted_.run.keyframes;
    return std::any_of(marginalised.begin(), marginalised.end(),
                       [&](const KeyframeRecord& k) { return k.frame_index == keyframe.frame_index; });
  }
  template <class T>
  static T read(ByteReader* in) {
    T value;
    read_value(in, &value);
    return value;
  }
  void add_frame(FrameRecord frame, bool ok) {
    if (ok) interrupted_.run.frames.push_back(std::move(frame));
  }
  void set_late_pose(FrameRecord late, bool ok) {
    auto& frames = interrupted_.run.frames;
    for (auto frame = frames.rbegin(); ok && frame != frames.rend(); ++frame)
      if (frame->index == late.index) {
        *frame = std::move(late);
        return;
      }
  }
  void add_keyframe(KeyframeRecord keyframe, bool ok) {
    if (!ok) return;
    interrupted_.run.keyframes.push_back(std::move(keyframe));
    interrupted_.frames_before_keyframe.push_back(interrupted_.run.frames.size());
  }
  void revise() {
    interrupted_.frames_before_keyframe.resize(revised_.size(), interrupted_.run.frames.size());
    interrupted_.run.keyframes = std::move(revised_);
    revised_.clear();
    ++revisions_;
    interrupted_.camera_was_corrected = true;
  }

  InterruptedRun& interrupted_;
  std::vector<KeyframeRecord> revised_;
  uint32_t revisions_ = 0;
};

void check_is_interrupted(const std::string& folder) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(recovery_log_path(folder), ignored))
    throw InputError(folder, "holds no interrupted run (there is no " + std::string(kRecoveryLog) + ")",
                     "give the folder of a run that was killed");
  if (GrowingFile::is_growing(recovery_log_path(folder)))
    throw InputError(folder, "its run is still in progress", "wait for it, or end it with Ctrl-C");
}

}  // namespace

InterruptedRun read_recovery_log(const std::string& folder) {
  check_is_interrupted(folder);
  InterruptedRun interrupted;
  RecordFile file(recovery_log_path(folder));
  Rebuilder rebuilder(&interrupted);
  RecoveryRecord record;
  if (!file.next(&record) || record.kind != RecoveryKind::kHeader || !rebuilder.take(record))
    throw InputError(recovery_log_path(folder), "is incomplete, or was written by another version of edgevo",
                     "run the sequence again with --force");
  while (file.next(&record) && rebuilder.take(record)) {
  }
  RecordFile window((std::filesystem::path(folder) / kRunWindow).string());
  if (window.next(&record)) rebuilder.add_window(record);
  interrupted.run.T_vehicle_cam = interrupted.header.T_vehicle_cam;
  interrupted.run.pinhole = interrupted.header.info.camera.pinhole;
  return interrupted;
}

}  // namespace edgevo
