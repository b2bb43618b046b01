// The files in params/ are what users start from: each must be readable, and default.yaml must list the defaults, all of them.
#include <gtest/gtest.h>

#include <filesystem>

#include "edgevo/core/error.h"
#include "edgevo/results/run_params.h"

namespace edgevo {
namespace {

const std::string kFolder = std::string(EDGEVO_SOURCE_DIR) + "/params/";

std::string written(RunParams params) {
  return write_params([&](ParamVisitor& v) { params.visit(v); });
}

TEST(ParamsFiles, EachIsReadable) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
    RunParams params;
    EXPECT_NO_THROW(read_params_file(entry.path().string(), [&](ParamVisitor& v) { params.visit(v); })) << entry.path();
    ++files;
  }
  EXPECT_EQ(files, 7);
}

TEST(ParamsFiles, DefaultYamlListsEveryParameterWithItsDefault) {
  // Start from other values everywhere, so that a key missing in the file would show.
  class Disturb : public ParamVisitor {
   public:
    void number(const char*, double& value, double min, double max, const char*) override { value = value == min ? max : min; }
    void integer(const char*, int& value, int min, int max, const char*) override { value = value == min ? max : min; }
    void boolean(const char*, bool& value, const char*) override { value = !value; }
    void text(const char*, std::string& value, const std::vector<std::string>& choices, const char*) override {
      value = choices.empty() ? value + "x" : choices.front() == value ? choices.back() : choices.front();
    }
    void begin_group(const char*) override {}
    void end_group() override {}
  };
  RunParams params;
  Disturb disturb;
  params.visit(disturb);
  ASSERT_NE(written(params), written(RunParams()));
  read_params_file(kFolder + "default.yaml", [&](ParamVisitor& v) { params.visit(v); });
  EXPECT_EQ(written(params), written(RunParams()));
}

TEST(ParamsFiles, UnknownKeyOffersTheNearest) {
  RunParams params;
  try {
    read_params("mapping:\n  window:\n    keyframe: 9\n", "test.yaml", [&](ParamVisitor& v) { params.visit(v); });
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("mapping.window.keyframes"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace edgevo
