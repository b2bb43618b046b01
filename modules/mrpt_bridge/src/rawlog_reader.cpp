// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mrpt_bridge/rawlog_reader.h"

#include <mrpt/maps/registerAllClasses.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/obs/registerAllClasses.h>

#include "edgevo/core/error.h"
#include "gz_archive.h"

namespace edgevo {
namespace {

void register_classes() {
  static const bool once = [] {
    mrpt::obs::registerAllClasses_mrpt_obs();
    mrpt::maps::registerAllClasses_mrpt_maps();
    return true;
  }();
  (void)once;
}

// "... Stored object has class 'X' which is not registered! ..." -> X; empty if the message is another one.
std::string unregistered_class(const std::string& message) {
  const size_t end = message.find("' which is not registered");
  if (end == std::string::npos) return {};
  const size_t begin = message.rfind('\'', end - 1);
  return begin == std::string::npos ? std::string() : message.substr(begin + 1, end - begin - 1);
}

bool is_printable(const std::string& text) {
  for (const unsigned char c : text)
    if (c < 0x20 || c > 0x7e) return false;
  return !text.empty();
}

}  // namespace

RawlogReader::RawlogReader(const std::string& path)
    : path_(path), archive_(std::make_unique<GzInputArchive>(path)) {
  register_classes();
}

RawlogReader::~RawlogReader() = default;

int64_t RawlogReader::position() const { return archive_->position(); }

mrpt::obs::CObservation::Ptr RawlogReader::next() {
  while (pending_.empty()) {
    if (done_) return nullptr;
    done_ = true;  // stays so if read_object() throws
    done_ = !read_object();
  }
  auto observation = pending_.front();
  pending_.pop_front();
  return observation;
}

// Reads one object into pending_; false at the true end of the file.
bool RawlogReader::read_object() {
  const std::string where = path_ + ", after " + std::to_string(objects_) + " objects";
  if (archive_->at_end()) {
    if (archive_->damage().empty()) return false;
    throw InputError(where, archive_->damage(), "copy the rawlog again; what came before was read");
  }
  mrpt::serialization::CSerializable::Ptr object;
  try {
    object = archive_->ReadObject();
  } catch (const std::exception& e) {
    if (archive_->ran_short())
      throw InputError(where, archive_->damage(), "copy the rawlog again; what came before was read");
    const std::string name = unregistered_class(e.what());
    if (is_printable(name))
      throw InputError(where, "an object of the unknown class '" + name + "' follows",
                       "remove it with the tool that wrote it; nothing after it can be read");
    throw InputError(where, "no MRPT object follows", "check that the file is a rawlog and copy it again");
  }
  ++objects_;
  if (auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object))
    pending_.push_back(std::move(observation));
  else if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object))
    pending_.insert(pending_.end(), frame->begin(), frame->end());
  return true;
}

}  // namespace edgevo
