// SPDX-License-Identifier: BSD-3-Clause
#include "trace_file.h"

#include <cstdio>

#include "edgevo/core/error.h"
#include "edgevo/core/trace.h"

namespace edgevo {

TraceFile::TraceFile(const std::string& path) {
  if (path.empty()) return;
  try {
    file_.emplace(path);
  } catch (const InputError&) {
    throw InputError("--trace " + path, "cannot be written", "give a file in a folder that exists");
  }
  begin_trace();
}

TraceFile::~TraceFile() {
  try {
    if (file_) close();
  } catch (const InputError& e) {
    std::fprintf(stderr, "edgevo: %s\n", e.what());
  }
}

void TraceFile::close() {
  if (!file_) return;
  file_->write(end_trace());
  file_->close();
  file_.reset();
}

}  // namespace edgevo
