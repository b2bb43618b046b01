// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Disk space that is reserved before a run and released for its text files, so that a full disk does not cost
// the trajectory.
//
// Images and maps are large and may fill a disk; trajectories, frames.csv and summary.yaml are small, come
// last and matter most. The file that reserves the space has no name: it disappears with the process, however
// that ends.
#include <cstddef>
#include <string>

namespace edgevo {

/// Reserved disk space.
class SpaceReserve {
 public:
  /// Reserves `bytes` on the disk of `folder`, if its file system supports that. Throws InputError if they
  /// are not free.
  SpaceReserve(const std::string& folder, size_t bytes);
  ~SpaceReserve() { release(); }
  SpaceReserve(const SpaceReserve&) = delete;
  SpaceReserve& operator=(const SpaceReserve&) = delete;

  /// Releases the space; may be called more than once.
  void release();

 private:
  int file_ = -1;
};

}  // namespace edgevo
