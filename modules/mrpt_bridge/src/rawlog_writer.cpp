#include "edgevo/mrpt_bridge/rawlog_writer.h"

#include <filesystem>

#include "gz_archive.h"

namespace edgevo {

RawlogWriter::RawlogWriter(const std::string& path) : archive_(std::make_unique<GzOutputArchive>(path)) {}

RawlogWriter::~RawlogWriter() = default;

void RawlogWriter::write(const mrpt::serialization::CSerializable& object) {
  try {
    *archive_ << object;
  } catch (const std::exception&) {
    if (archive_->failure() != 0) archive_->throw_failure();
    throw;
  }
}

void RawlogWriter::close() { archive_->close(); }

std::string rawlog_stem(const std::string& rawlog_path) {
  std::filesystem::path path(rawlog_path);
  return path.replace_extension().string();
}

}  // namespace edgevo
