// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A video of varying rate: the packets of another one with other stamps.
#include <gtest/gtest.h>

#include <functional>
#include <string>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

namespace edgevo::test {

/// Copies the video stream of `from`, frame i with the time of `step_of(i)` of its frames.
inline void write_varying_video(const std::string& from, const std::string& to,
                                const std::function<int(int)>& step_of) {
  AVFormatContext *in = nullptr, *out = nullptr;
  ASSERT_EQ(avformat_open_input(&in, from.c_str(), nullptr, nullptr), 0);
  ASSERT_GE(avformat_find_stream_info(in, nullptr), 0);
  ASSERT_GE(avformat_alloc_output_context2(&out, nullptr, nullptr, to.c_str()), 0);
  AVStream* stream = avformat_new_stream(out, nullptr);
  ASSERT_GE(avcodec_parameters_copy(stream->codecpar, in->streams[0]->codecpar), 0);
  stream->codecpar->codec_tag = 0;
  const AVRational frame = av_inv_q(in->streams[0]->r_frame_rate);
  stream->time_base = frame;
  ASSERT_GE(avio_open(&out->pb, to.c_str(), AVIO_FLAG_WRITE), 0);
  ASSERT_GE(avformat_write_header(out, nullptr), 0);
  AVPacket* packet = av_packet_alloc();
  for (int i = 0; av_read_frame(in, packet) >= 0; ++i) {
    packet->pts = packet->dts = av_rescale_q(step_of(i), frame, stream->time_base);
    packet->duration = 0;
    ASSERT_GE(av_interleaved_write_frame(out, packet), 0);
  }
  av_packet_free(&packet);
  av_write_trailer(out);
  avio_closep(&out->pb);
  avformat_free_context(out);
  avformat_close_input(&in);
}

}  // namespace edgevo::test
