// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/results/run_folder.h"

#include <filesystem>

#include "edgevo/core/output_file.h"

namespace edgevo {
namespace {

// Drops the call stacks that libraries append.
std::string first_line(const std::string& text) { return text.substr(0, text.find_first_of("\r\n")); }

}  // namespace

RunFolder::RunFolder(std::string path) : path_(std::move(path)) { make_output_folder(path_); }

std::string RunFolder::path_of(const std::string& file) const {
  return (std::filesystem::path(path_) / file).string();
}

void RunFolder::attempt(const std::string& file, const std::function<void(const std::string& path)>& write) {
  const std::string path = path_of(file);
  try {
    write(path);
  } catch (const InputError& e) {
    note_failure(file, e);
  } catch (const std::exception& e) {
    note_failure(file, InputError(path, "cannot be written: " + first_line(e.what()), ""));
  }
}

void RunFolder::note_failure(const std::string& file, const InputError& error) {
  not_written_.push_back(file);
  if (!first_failure_) first_failure_ = error;
}

void RunFolder::throw_first_failure() const {
  if (first_failure_) throw *first_failure_;
}

}  // namespace edgevo
