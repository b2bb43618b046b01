// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A source as another sequence on disk: converted, under changed light, or with foreign bodies.
#include <string>

#include "edgevo/sequence_output/sequence_host.h"
#include "edgevo/simulation/overlay.h"

namespace edgevo {

/// `edgevo import`: a source as a rawlog.
struct ImportRequest {
  /// The source.
  SourceOptions source;
  /// OUT.rawlog.
  std::string out;
  /// Whether to overwrite existing files.
  bool force = false;
};
/// Throws InputError.
void write_imported(const ImportRequest& request, const SequenceHost& host);

/// `edgevo relight`: a source under changed light, as a folder or a rawlog.
struct RelightRequest {
  /// The source.
  SourceOptions source;
  /// Folder or OUT.rawlog.
  std::string out;
  /// Kind of the change (relight_kinds()), and its seed.
  std::string kind = "mixed";
  /// Seed of the changes.
  uint64_t seed = 1;
  /// Whether to overwrite existing files.
  bool force = false;
};
/// Throws InputError.
void write_relit(const RelightRequest& request, const SequenceHost& host);

/// `edgevo overlay`: a source with foreign bodies and their masks, as a folder.
struct OverlayRequest {
  /// The source.
  SourceOptions source;
  /// The bodies.
  OverlayOptions overlay;
  /// Folder to write.
  std::string out;
  /// Whether to overwrite existing files.
  bool force = false;
};
/// Throws InputError.
void write_overlaid(const OverlayRequest& request, const SequenceHost& host);

}  // namespace edgevo
