#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "bytes.h"
#include "edgevo/core/error.h"
#include "growing_file.h"
#include "journal_format.h"
#include "journal_values.h"

namespace edgevo {
namespace {

constexpr uint32_t kLargestRecord = 1u << 28;  // bytes: a keyframe has a thousandth of that

struct JournalRecord {
  JournalKind kind;
  std::string content;
};

// The records of a file one by one, as far as it is whole.
class RecordFile {
 public:
  explicit RecordFile(const std::string& path) : file_(std::fopen(path.c_str(), "rb"), &std::fclose) {
    std::string first;
    is_whole_ = file_ && read(kJournalFirstLine.size(), &first) && first == kJournalFirstLine;
  }
  bool next(JournalRecord* record) {
    std::string head, tail;
    if (!is_whole_ || !read(sizeof(JournalKind) + sizeof(uint32_t), &head)) return false;
    ByteReader in(head);
    record->kind = in.value<JournalKind>();
    const auto size = in.value<uint32_t>();
    is_whole_ =
        size <= kLargestRecord && read(size, &record->content) && read(sizeof(uint32_t), &tail) &&
        ByteReader(tail).value<uint32_t>() == journal_checksum(journal_checksum(0, head), record->content);
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

// Puts the run together again.
class Rebuilder {
 public:
  explicit Rebuilder(CutOffRun* cut_off) : cut_off_(*cut_off) {}

  /// False: the content is not what its kind says.
  bool take(const JournalRecord& record) {
    ByteReader in(record.content);
    switch (record.kind) {
      case JournalKind::kHeader:
        read_value(&in, &cut_off_.header);
        break;
      case JournalKind::kFrame:
        add_frame(read<FrameRecord>(&in), in.ok());
        break;
      case JournalKind::kLatePose:
        set_late_pose(read<FrameRecord>(&in), in.ok());
        break;
      case JournalKind::kCamera:
        read_value(&in, &cut_off_.run.camera);
        break;
      case JournalKind::kKeyframe:
        add_keyframe(read<KeyframeRecord>(&in), in.ok());
        break;
      case JournalKind::kRevisedKeyframe:
        revised_.push_back(read<KeyframeRecord>(&in));
        break;
      case JournalKind::kRevised:
        revise();
        break;
      default:
        return false;
    }
    return in.ok();
  }

  /// Keyframes that had not settled when their file was written; those that have by now are left out. In the
  /// moment in which a correction of the camera is written they are of before it, and are not taken.
  void add_window(const JournalRecord& record) {
    ByteReader in(record.content);
    const auto revisions = in.value<uint32_t>();
    std::vector<KeyframeRecord> window;
    read_value(&in, &window);
    if (record.kind != JournalKind::kWindow || !in.ok() || revisions != revisions_) return;
    for (KeyframeRecord& keyframe : window)
      if (!is_settled(keyframe)) {
        add_keyframe(std::move(keyframe), true);
        ++cut_off_.unsettled;
      }
  }

 private:
  bool is_settled(const KeyframeRecord& keyframe) const {
    const auto& settled = cut_off_.run.keyframes;
    return std::any_of(settled.begin(), settled.end(),
                       [&](const KeyframeRecord& k) { return k.frame_index == keyframe.frame_index; });
  }
  template <class T>
  static T read(ByteReader* in) {
    T value;
    read_value(in, &value);
    return value;
  }
  void add_frame(FrameRecord frame, bool ok) {
    if (ok) cut_off_.run.frames.push_back(std::move(frame));
  }
  void set_late_pose(FrameRecord late, bool ok) {
    auto& frames = cut_off_.run.frames;
    for (auto frame = frames.rbegin(); ok && frame != frames.rend(); ++frame)
      if (frame->index == late.index) {
        *frame = std::move(late);
        return;
      }
  }
  void add_keyframe(KeyframeRecord keyframe, bool ok) {
    if (!ok) return;
    cut_off_.run.keyframes.push_back(std::move(keyframe));
    cut_off_.frames_before_keyframe.push_back(cut_off_.run.frames.size());
  }
  void revise() {
    cut_off_.frames_before_keyframe.resize(revised_.size(), cut_off_.run.frames.size());
    cut_off_.run.keyframes = std::move(revised_);
    revised_.clear();
    ++revisions_;
    cut_off_.camera_was_corrected = true;
  }

  CutOffRun& cut_off_;
  std::vector<KeyframeRecord> revised_;
  uint32_t revisions_ = 0;
};

void check_is_cut_off(const std::string& folder) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(journal_path(folder), ignored))
    throw InputError(folder, "no run was cut off here (there is no " + std::string(kRunJournal) + ")",
                     "give the folder of a run that was killed");
  if (GrowingFile::is_growing(journal_path(folder)))
    throw InputError(folder, "its run is still going on", "wait for it, or end it with Ctrl-C");
}

}  // namespace

CutOffRun read_run_journal(const std::string& folder) {
  check_is_cut_off(folder);
  CutOffRun cut_off;
  RecordFile file(journal_path(folder));
  Rebuilder rebuilder(&cut_off);
  JournalRecord record;
  if (!file.next(&record) || record.kind != JournalKind::kHeader || !rebuilder.take(record))
    throw InputError(journal_path(folder), "is not whole, or of another version of edgevo",
                     "run the sequence again with --force");
  while (file.next(&record) && rebuilder.take(record)) {
  }
  RecordFile window((std::filesystem::path(folder) / kRunWindow).string());
  if (window.next(&record)) rebuilder.add_window(record);
  cut_off.run.T_vehicle_cam = cut_off.header.T_vehicle_cam;
  cut_off.run.pinhole = cut_off.header.info.camera.pinhole;
  return cut_off;
}

}  // namespace edgevo
