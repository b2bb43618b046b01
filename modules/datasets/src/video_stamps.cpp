// SPDX-License-Identifier: BSD-3-Clause
#include "video_stamps.h"

#include <algorithm>
#include <cmath>
#include <memory>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/log.h>
}

namespace edgevo {
namespace {

struct CloseInput {
  void operator()(AVFormatContext* context) const { avformat_close_input(&context); }
};
struct FreePacket {
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
};

// Silences FFmpeg's messages about a damaged file: it is reported at its frames.
class QuietFfmpeg {
 public:
  QuietFfmpeg() : level_(av_log_get_level()) { av_log_set_level(AV_LOG_QUIET); }
  ~QuietFfmpeg() { av_log_set_level(level_); }
  QuietFfmpeg(const QuietFfmpeg&) = delete;
  QuietFfmpeg& operator=(const QuietFfmpeg&) = delete;

 private:
  int level_;
};

std::unique_ptr<AVFormatContext, CloseInput> open_input(const std::string& path) {
  AVFormatContext* context = nullptr;
  if (avformat_open_input(&context, path.c_str(), nullptr, nullptr) < 0) return nullptr;
  std::unique_ptr<AVFormatContext, CloseInput> input(context);
  if (avformat_find_stream_info(context, nullptr) < 0) return nullptr;
  return input;
}

// The packets of a stream in the order of the file.
struct Packets {
  std::vector<int64_t> stamps;     // of those that are shown; empty if one has none
  std::vector<int64_t> positions;  // in the file
};

Packets read_packets(AVFormatContext* input, int stream) {
  Packets packets;
  bool have_stamps = true;
  const std::unique_ptr<AVPacket, FreePacket> packet(av_packet_alloc());
  for (; have_stamps && av_read_frame(input, packet.get()) >= 0; av_packet_unref(packet.get())) {
    if (packet->stream_index != stream) continue;
    packets.positions.push_back(packet->pos);
    if (packet->flags & AV_PKT_FLAG_DISCARD) continue;
    have_stamps = packet->pts != AV_NOPTS_VALUE;
    packets.stamps.push_back(packet->pts);
  }
  if (!have_stamps) packets = {};
  return packets;
}

// Which entries of an index have data that no packet came from; those after the last packet are cut off.
std::vector<int> missing_entries(const AVStream& stream, std::vector<int64_t> positions) {
  constexpr int64_t kHeader = 8;  // bytes between the start of a chunk of AVI and its data
  std::sort(positions.begin(), positions.end());
  std::vector<int> missing;
  for (int i = 0; i < int(stream.nb_frames) && !positions.empty(); ++i) {
    const int64_t stated = avformat_index_get_entry(const_cast<AVStream*>(&stream), i)->pos;
    const auto found = std::lower_bound(positions.begin(), positions.end(), stated);
    if (found == positions.end()) break;
    if (*found > stated + kHeader) missing.push_back(i);
  }
  return missing;
}

}  // namespace

VideoStamps read_video_stamps(const std::string& path) {
  const QuietFfmpeg quiet;
  const auto input = open_input(path);
  if (!input) return {};
  const int index = av_find_best_stream(input.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  if (index < 0) return {};
  const AVStream& stream = *input->streams[index];
  VideoStamps result;
  const int format = stream.codecpar->format;
  result.is_16_bit_gray = format == AV_PIX_FMT_GRAY16LE || format == AV_PIX_FMT_GRAY16BE;
  // Before the packets are read, which adds to an index that lists only some.
  const int listed = avformat_index_get_entries_count(&stream);
  Packets packets = read_packets(input.get(), index);
  std::vector<int64_t>& stamps = packets.stamps;
  std::sort(stamps.begin(), stamps.end());  // frames are stored in the order of decoding
  if (std::adjacent_find(stamps.begin(), stamps.end()) != stamps.end()) return result;
  for (const int64_t stamp : stamps)
    result.seconds.push_back(double(stamp - stamps.front()) * av_q2d(stream.time_base));
  if (listed > 0 && listed == stream.nb_frames) result.missing = missing_entries(stream, packets.positions);
  result.is_complete = int64_t(stamps.size() + result.missing.size()) == stream.nb_frames;
  return result;
}

bool is_drawn_text(const std::string& path) {
  const QuietFfmpeg quiet;
  const auto input = open_input(path);
  if (!input) return false;
  const int index = av_find_best_stream(input.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  if (index < 0) return false;
  const AVCodecID codec = input->streams[index]->codecpar->codec_id;
  return codec == AV_CODEC_ID_ANSI || codec == AV_CODEC_ID_BINTEXT || codec == AV_CODEC_ID_XBIN ||
         codec == AV_CODEC_ID_IDF;
}

bool have_rate(const std::vector<double>& seconds, double fps) {
  constexpr double kResolution = 1e-3, kShare = 0.01;
  const double tolerance = std::max(kResolution, kShare / fps);
  for (size_t i = 0; i < seconds.size(); ++i)
    if (std::abs(seconds[i] - double(i) / fps) > tolerance) return false;
  return true;
}

}  // namespace edgevo
