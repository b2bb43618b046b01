// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Records of a run as bytes and back. A value read is complete only if the reader is still ok().
#include "bytes.h"
#include "edgevo/results/recovery_log.h"

namespace edgevo {

void write_value(const RecoveryHeader& header, ByteWriter* out);
void write_value(const FrameRecord& frame, ByteWriter* out);
void write_value(const KeyframeRecord& keyframe, ByteWriter* out);
void write_value(const CameraRefinement& camera, ByteWriter* out);
void write_value(const std::vector<KeyframeRecord>& keyframes, ByteWriter* out);

void read_value(ByteReader* in, RecoveryHeader* header);
void read_value(ByteReader* in, FrameRecord* frame);
void read_value(ByteReader* in, KeyframeRecord* keyframe);
void read_value(ByteReader* in, CameraRefinement* camera);
void read_value(ByteReader* in, std::vector<KeyframeRecord>* keyframes);

}  // namespace edgevo
