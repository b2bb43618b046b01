#pragma once
// What an earlier run has left in the folder that a new one is to fill. It stays whole until the new run has
// something to keep: its files wait in `earlier_run` within the folder from the new run's first frame to its
// first pose.
#include <string>
#include <vector>

namespace edgevo {

constexpr const char* kEarlierRun = "earlier_run";  ///< the folder within a run's folder

class EarlierRun {
 public:
  /// Looks into the folder (which may not be there yet) and changes nothing. Throws InputError when it holds
  /// something else than a run, or a run that was not written to its end, unless `force`; and when a run is
  /// going on there.
  EarlierRun(std::string folder, bool force);

  /// The new run begins: puts what the earlier one left aside, so that the two do not mix. Files that no run
  /// writes stay where they are. Throws InputError.
  void set_aside();
  /// The new run has something to keep.
  void remove();
  /// The earlier run lies in `earlier_run`.
  bool is_set_aside() const;

 private:
  std::vector<std::string> files_of_runs() const;

  std::string folder_;
};

}  // namespace edgevo
