#include "gpu/gl_buffer.hpp"
#include "gpu/gl_program.hpp"
#include "gpu/gl_timer.hpp"
#include "gpu/stage_timers.hpp"
#include "tests/gpu/device_test.hpp"

#include <epoxy/gl.h>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace radiosity {
namespace {

/// What the error of a call says; empty if there is none.
template <typename Call>
std::string complaint_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(GlLibraries, ThatAreMissingAreNamedWithTheirPackage) {
  EXPECT_EQ(missing_gl_library({}), "");
  EXPECT_EQ(missing_gl_library({{{"libm.so.6"}, "libc6"}, {{"no-such-library.so.1", "libm.so.6"}, "libc6"}}),
            "");
  const std::string sentence =
      missing_gl_library({{{"libm.so.6"}, "libc6"}, {{"no-such-library.so.1"}, "its-package"}});
  for (const char* part : {"no-such-library.so.1", "its-package", "libgl1-mesa-dri"})
    EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
}

TEST(GlLibraries, ThatAreMissingEndInAnErrorAndNotInAnAbort) {
  const std::string sentence = complaint_of([] {
    GlContext::open({.libraries = {{{"no-such-library.so.1"}, "its-package"}}});
  });
  EXPECT_NE(sentence.find("its-package"), std::string::npos) << sentence;
  EXPECT_TRUE(sentence.ends_with(", or use --device cpu")) << sentence;
}

using Context = DeviceTest;

TEST_F(Context, SaysWhatItIsAndWhatItsLimitsAre) {
  const GlContext& context = *device()->context();
  EXPECT_FALSE(context.renderer().empty());
  EXPECT_GE(context.version(), "4.3");
  // The least that OpenGL 4.3 allows.
  EXPECT_GE(context.limits().storage_block_bytes, 1 << 24);
  EXPECT_GE(context.limits().group_count[0], 65535);
  EXPECT_GE(context.limits().group_invocations, 1024);
  EXPECT_GE(context.limits().shared_bytes, 32768);
  EXPECT_EQ(context.software(), renderer_text(context).find("software") != std::string::npos);
}

TEST_F(Context, TurnsWhatTheDriverComplainsOfIntoAnError) {
  const GlContext& context = *device()->context();
  const CurrentContext current(context);
  glBindBuffer(GL_TEXTURE_2D, 0);  // not a kind of buffer
  const std::string sentence = complaint_of([&] { context.check("a mistake"); });
  EXPECT_NE(sentence.find("a mistake"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("says"), std::string::npos) << "not from the debug output: " << sentence;
  EXPECT_EQ(complaint_of([&] { context.check("nothing"); }), "");
}

TEST_F(Context, WithoutDebugOutputReportsErrorsToo) {
  const auto plain = GlContext::open({.debug = false});
  const CurrentContext current(*plain);
  glBindBuffer(GL_TEXTURE_2D, 0);
  EXPECT_NE(complaint_of([&] { plain->check("a mistake"); }).find("invalid enum"), std::string::npos);
}

TEST_F(Context, ServesSeveralThreadsOneAfterTheOther) {
  const auto& context = device()->context();
  std::vector<int> read(4, -1);
  std::vector<std::thread> threads;
  threads.reserve(read.size());
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int repetition = 0; repetition < 20; ++repetition) {
        const CurrentContext current(*context);
        GlBuffer buffer(context, sizeof t);
        buffer.write(0, sizeof t, &t);
        buffer.read(sizeof t, &read[static_cast<std::size_t>(t)]);
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(read, (std::vector<int>{0, 1, 2, 3}));
}

TEST_F(Context, RefusesABufferThatNoDeviceHasRoomFor) {
  const CurrentContext current(*device()->context());
  const std::size_t petabyte = std::size_t{1} << 50;
  const std::string sentence = complaint_of([&] { GlBuffer(device()->context(), petabyte); });
  EXPECT_NE(sentence.find("1125899906842624 bytes"), std::string::npos) << sentence;
}

TEST_F(Context, GivesTheLogOfAShaderThatDoesNotCompile) {
  const CurrentContext current(*device()->context());
  const std::string sentence = complaint_of([&] {
    GlProgram(device()->context(), "broken.comp", "#version 430 core\nvoid main() { not_declared = 1; }\n");
  });
  EXPECT_NE(sentence.find("broken.comp"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("not_declared"), std::string::npos) << sentence;
  complaint_of([] { device()->context()->check("its message"); });
}

TEST_F(Context, RefusesUniformsThatAShaderHasNot) {
  const CurrentContext current(*device()->context());
  const GlProgram& program = device()->program({"dense_texels.comp", {{"COLUMNS", 1}, {"EIGHT", 0}}});
  EXPECT_NE(complaint_of([&] { program.set("no_such_uniform", 1); }).find("no_such_uniform"),
            std::string::npos);
}

TEST_F(Context, TimesTheDevice) {
  const CurrentContext current(*device()->context());
  GlTimer timer(device()->context());
  std::optional<GlTimer::Measurement> measurement(timer);
  GlBuffer buffer(device()->context(), 1 << 20);
  measurement.reset();
  EXPECT_GE(timer.seconds(), 0);
  EXPECT_LT(timer.seconds(), 10);
}

TEST_F(Context, TimesStagesByEitherClock) {
  const CurrentContext current(*device()->context());
  for (const StageTimers::Clock clock : {StageTimers::Clock::device, StageTimers::Clock::finishing}) {
    StageTimers timers(device()->context(), 2, 2, clock);
    for (const int frame : {0, 1}) {
      timers.begin(frame);
      timers.end_stage(frame, 0);
      GlBuffer buffer(device()->context(), 1 << 20);
      timers.end_stage(frame, 1);
    }
    glFinish();
    for (const int frame : {0, 1})
      for (const double seconds : timers.seconds(frame)) {
        EXPECT_GE(seconds, 0);
        EXPECT_LT(seconds, 10);
      }
    device()->context()->check("timers");
  }
}

}  // namespace
}  // namespace radiosity
