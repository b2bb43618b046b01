#pragma once
// The folder that a run leaves on disk, and its one owner: makes it, knows where each file lies, and what
// could not be written. One file that cannot be does not keep the others from being tried: each failure is
// noted, and told in the end.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/error.h"

namespace edgevo {

/// The folder of one run.
class RunFolder {
 public:
  /// Makes the folder and those above it. Throws InputError: a file is in the way, or it may not be made.
  explicit RunFolder(std::string path);

  const std::string& path() const { return path_; }  ///< as given
  /// Where `file` lies, or will.
  std::string path_of(const std::string& file) const;

  /// Does `write(path of the file)`; whatever that throws is noted.
  void attempt(const std::string& file, const std::function<void(const std::string& path)>& write);
  void note_failure(const std::string& file, const InputError& error);  ///< For what attempt() does not do.

  /// What could not be written so far.
  const std::vector<std::string>& not_written() const { return not_written_; }
  /// Throws the first failure, if there was one.
  void tell_failures() const;

 private:
  std::string path_;
  std::optional<InputError> first_failure_;
  std::vector<std::string> not_written_;
};

}  // namespace edgevo
