// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/trace.h"

#include <gmock/gmock.h>

#include <thread>

namespace edgevo {
namespace {

using testing::HasSubstr;
using testing::Not;

size_t count(const std::string& text, const std::string& part) {
  size_t n = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(Trace, RecordsNothingWhileItIsOff) {
  { const TraceScope scope("unseen"); }
  begin_trace();
  const std::string trace = end_trace();
  { const TraceScope scope("unseen"); }
  EXPECT_THAT(trace, Not(HasSubstr("unseen")));
  EXPECT_THAT(end_trace(), Not(HasSubstr("unseen")));
}

TEST(Trace, AScopeIsACompleteEventWithFrameAndKeyframe) {
  begin_trace();
  {
    TraceScope outer("a frame", 7);
    const TraceScope inner("its edges");
    outer.set_keyframe(3);
  }
  { const TraceScope later("no frame"); }
  const std::string trace = end_trace();
  EXPECT_EQ(count(trace, "\"ph\":\"X\""), 3u);
  // The inner scope ends first, and belongs to the frame around it.
  const size_t inner = trace.find("its edges"), outer = trace.find("a frame"), later = trace.find("no frame");
  ASSERT_LT(inner, outer);
  ASSERT_LT(outer, later);
  EXPECT_THAT(trace.substr(inner, outer - inner), HasSubstr("\"frame\":7"));
  EXPECT_THAT(trace.substr(outer, later - outer), HasSubstr("\"frame\":7,\"keyframe\":3"));
  EXPECT_THAT(trace.substr(later), Not(HasSubstr("\"frame\"")));
  EXPECT_THAT(trace.substr(later), HasSubstr("\"dur\":"));
  EXPECT_THAT(trace.substr(later), HasSubstr("\"cpu_ms\":"));
}

TEST(Trace, EachThreadHasALaneWithItsName) {
  begin_trace();
  for (const char* name : {"first", "second"})
    std::thread([name] {
      name_traced_thread(name);
      const TraceScope scope("work");
    }).join();
  const std::string trace = end_trace();
  EXPECT_THAT(trace, HasSubstr("\"args\":{\"name\":\"first\"}"));
  EXPECT_THAT(trace, HasSubstr("\"args\":{\"name\":\"second\"}"));
  const size_t a = trace.find("\"ph\":\"X\""), b = trace.rfind("\"ph\":\"X\"");
  const auto lane = [&](size_t event) { return trace.substr(trace.find("\"tid\"", event), 7); };
  EXPECT_NE(lane(a), lane(b));
}

TEST(Trace, IsAWholeDocumentWhileThreadsWork) {
  begin_trace();
  std::atomic<bool> stop{false};
  std::thread worker([&] {
    while (!stop) const TraceScope scope("work");
  });
  const TraceScope open("not left yet");
  const std::string trace = end_trace();
  stop = true;
  worker.join();
  EXPECT_EQ(trace.substr(trace.size() - 4), "\n]}\n");
  EXPECT_EQ(count(trace, "{"), count(trace, "}"));
  EXPECT_THAT(trace, Not(HasSubstr("not left yet")));
}

TEST(Trace, ASecondTraceHoldsNothingOfTheFirst) {
  begin_trace();
  { const TraceScope scope("of the first"); }
  begin_trace();
  EXPECT_THAT(end_trace(), Not(HasSubstr("of the first")));
}

}  // namespace
}  // namespace edgevo
