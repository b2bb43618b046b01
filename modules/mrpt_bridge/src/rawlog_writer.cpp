// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mrpt_bridge/rawlog_writer.h"

#include <filesystem>

#include "object_file.h"

namespace edgevo {

RawlogWriter::RawlogWriter(const std::string& path) : file_(std::make_unique<ObjectFile>(path)) {}

RawlogWriter::~RawlogWriter() = default;

void RawlogWriter::write(const mrpt::serialization::CSerializable& object) { file_->write(object); }

void RawlogWriter::close() { file_->close(); }

std::string rawlog_stem(const std::string& rawlog_path) {
  std::filesystem::path path(rawlog_path);
  return path.replace_extension().string();
}

}  // namespace edgevo
