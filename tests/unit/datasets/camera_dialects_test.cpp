// SPDX-License-Identifier: BSD-3-Clause
// Calibration files of other programs.
#include <sys/stat.h>

#include <map>

#include "camera_fit.h"
#include "camera_forms.h"
#include "edgevo/datasets/camera_file.h"
#include "edgevo/datasets/open_source.h"
#include "support/camera_dialects.h"
#include "unit/datasets/same_rays.h"
#include "unit/datasets/temp_sequence.h"

namespace edgevo {
namespace {

using test::camera_dialects;
using test::DialectText;
using test::error_of;
using test::expect_same_rays;
using ::testing::HasSubstr;

Camera camera_of(const CameraModel& model, int width = 640, int height = 480) {
  Camera camera;
  camera.model = model;
  camera.width = width, camera.height = height;
  return camera;
}

// What each file says, by the formulas of core/camera_models.h: focal lengths on the axis.
std::map<std::string, Camera> expected_cameras() {
  const Intrinsics narrow{500, 501, 320, 240}, fisheye{190, 191, 321, 238}, stated{250, 251, 321, 238},
      square{500, 500, 320, 240}, square_fisheye{190, 190, 321, 238};
  const Camera radtan = camera_of(PlumbBobModel{narrow, {0.1, -0.02, 0.001, 0.002, 0}}),
               radtan_k3 = camera_of(PlumbBobModel{narrow, {0.1, -0.02, 0.001, 0.002, 0.3}}),
               kb = camera_of(KannalaBrandtModel{fisheye, 0.01, 0.02, -0.03, 0.004}),
               omni = camera_of(OmniModel{{100, 100.4, 321, 238}, 1.5, {-0.1, 0.2, 0.001, -0.0005, 0}}),
               ds = camera_of(DoubleSphereModel{{200, 200.8, 321, 238}, 0.25, 0.6}),
               eucm = camera_of(ExtendedUnifiedModel{stated, 0.6, 1.1}),
               fov = camera_of(FovModel{{250 * 4 / M_PI, 251 * 4 / M_PI, 321, 238}, M_PI / 2}),
               pinhole = camera_of(PinholeModel{narrow}),
               rational = camera_of(
                   RationalModel{stated, {{3.1, 1.4, 2e-4, -1e-4, 0.05}, 3.4, 2.2, 0.26, 0, 0, 0, 0}});
  const double tango = 2 * std::tan(0.93 / 2) / 0.93;  // on the axis over stated, of DSO's example
  return {
      {"KalibrPinholeRadtan", radtan},
      {"KalibrOmniRadtan", omni},
      {"KalibrDoubleSphere", ds},
      {"KalibrEucm", eucm},
      {"KalibrPinholeEquidistant", kb},
      {"KalibrPinholeFov", fov},
      {"KalibrOmniNone", camera_of(OmniModel{{100, 100.4, 321, 238}, 1.5, {}})},
      {"KalibrPinholeNone", pinhole},
      {"OrbSlam3Fisheye", kb},
      {"OrbSlam2", radtan_k3},
      {"OrbSlam2RawLeft", camera_of(PlumbBobModel{{458.654, 457.296, 367.215, 248.375},
                                                  {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0}},
                                    752)},
      {"StellaFisheye", kb},
      {"BasaltDoubleSphere", ds},
      {"BasaltKannalaBrandt", kb},
      {"BasaltEucm", eucm},
      {"BasaltUcm", camera_of(ExtendedUnifiedModel{stated, 0.6, 1})},
      {"BasaltFov", fov},
      {"BasaltPinhole", pinhole},
      {"BasaltRadtan8", rational},
      {"ColmapSimplePinhole", camera_of(PinholeModel{square})},
      {"ColmapPinhole", pinhole},
      {"ColmapSimpleRadial", camera_of(PlumbBobModel{square, {0.1, 0, 0, 0, 0}})},
      {"ColmapRadial", camera_of(PlumbBobModel{square, {0.1, -0.02, 0, 0, 0}})},
      {"ColmapOpencv", radtan},
      {"ColmapOpencvFisheye", kb},
      {"ColmapFullOpencv", rational},
      {"ColmapFov", fov},
      {"ColmapSimpleRadialFisheye", camera_of(KannalaBrandtModel{square_fisheye, 0.01, 0, 0, 0})},
      {"ColmapRadialFisheye", camera_of(KannalaBrandtModel{square_fisheye, 0.01, 0.02, 0, 0})},
      {"ColmapThinPrismOfZero", kb},
      {"ColmapBinaryFisheye", kb},
      {"DsoFovRelative",
       camera_of(FovModel{{tango * 0.390625 * 640, tango * 0.5229166667 * 480, 321, 238}, 0.93})},
      {"DsoFovInPixels", fov},
      {"DsoEquiDistant", kb},
      {"DsoPinhole", pinhole},
      {"MrptIni", radtan_k3},
      {"MrptIniFisheyeRight", kb},
      {"VispXml", camera_of(PlumbBobModel{narrow, {0.1, 0, 0, 0, 0}})},
      {"VispTrackerXml", pinhole},
      {"OpencvXmlFisheye", kb},
      {"VinsPinhole", radtan},
      {"VinsMei", omni},
      {"VinsKannalaBrandt", kb}};
}

class CameraDialect : public ::testing::TestWithParam<DialectText> {};

TEST_P(CameraDialect, IsReadTo1e9) {
  const auto expected = expected_cameras();
  const auto it = expected.find(GetParam().name);
  ASSERT_NE(it, expected.end());
  expect_same_rays(parse_camera(GetParam().text, "f", GetParam().sensor), it->second);
}

INSTANTIATE_TEST_SUITE_P(All, CameraDialect, ::testing::ValuesIn(camera_dialects()),
                         [](const auto& test) { return std::string(test.param.name); });

std::string text_of(const std::string& name) {
  for (const DialectText& dialect : camera_dialects())
    if (dialect.name == name) return dialect.text;
  return {};
}

TEST(CameraDialects, OneOfSeveralCamerasHasToBeChosen) {
  const std::string kalibr = text_of("KalibrPinholeRadtan");
  EXPECT_THAT(error_of([&] { parse_camera(kalibr, "f"); }),
              HasSubstr("f: holds several cameras; choose one with --sensor: cam0, cam1, cam2"));
  EXPECT_THAT(error_of([&] { parse_camera(kalibr, "f", "left"); }), HasSubstr("none of them 'left'"));
  EXPECT_EQ(parse_camera_text(kalibr, "f", "cam2").note, "cam2");
}

TEST(CameraDialects, TheChoiceReachesTheSource) {
  test::TempFolder folder;
  test::write_images(folder / "images_only", 2);
  test::write_text(folder / "cameras.txt", "1 PINHOLE 24 16 20 20 12 8\n2 PINHOLE 24 16 30 30 12 8\n");
  SourceOptions options;
  options.path = folder / "images_only";
  options.camera_file = folder / "cameras.txt";
  options.sensor_label = "2";
  const auto source = open_source(options);
  EXPECT_EQ(source->camera().pinhole().fx, 30);
  options.sensor_label = "3";
  EXPECT_THAT(error_of([&] { open_source(options); }), HasSubstr("none of them '3'"));
}

TEST(CameraDialects, ColmapDatabase) {
  test::TempFolder folder;
  const std::string path = folder / "database.db";
  test::write_colmap_database(path);
  expect_same_rays(read_camera_file(path, "1"),
                   camera_of(PlumbBobModel{{500, 501, 320, 240}, {0.1, -0.02, 0.001, 0.002, 0}}));
  EXPECT_EQ(read_camera_text(path, "1").doubt, "");
  EXPECT_THAT(read_camera_text(path, "2").doubt, HasSubstr("initial guess"));
  EXPECT_EQ(read_camera_mount(path), std::nullopt);
  test::write_text(path, test::read_text(path).substr(0, 3000));
  EXPECT_THAT(error_of([&] { read_camera_file(path, "1"); }), HasSubstr("is no database of COLMAP"));
}

TEST(CameraDialects, AFolderOfColmapIsReadAnyOtherRefused) {
  const TempFolder folder;
  std::filesystem::create_directories(folder / "model/sparse/0");
  EXPECT_THAT(error_of([&] { read_camera_file(folder / "model"); }),
              HasSubstr("model: is a folder without COLMAP's cameras.txt"));
  test::write_text(folder / "model/sparse/0/cameras.txt", "1 PINHOLE 640 480 500 501 320 240\n");
  for (const char* path : {"model", "model/sparse", "model/sparse/0"})
    EXPECT_EQ(read_camera_file(folder / path).width, 640) << path;
  EXPECT_FALSE(read_camera_gyro(folder / "model"));
  EXPECT_FALSE(read_camera_mount(folder / "model"));
  test::write_colmap_database(folder / "model/database.db");
  EXPECT_EQ(read_camera_file(folder / "model").pinhole().fx, 500) << "not the guess in the database";
}

TEST(CameraDialects, VispsJsonHasNoSize) {
  const std::string with =
      R"({"model":"perspectiveWithDistortion","px":500,"py":501,"u0":320,"v0":240,"kud":0.1,"kdu":-0.09})";
  const CameraText text = parse_camera_text(with, "visp.json", "");
  EXPECT_FALSE(text.has_size());
  const auto* lens = std::get_if<PlumbBobModel>(&text.camera.model);
  ASSERT_TRUE(lens);
  EXPECT_EQ(lens->fy, 501);
  EXPECT_THAT(
      error_of([] { parse_camera_text(R"({"model":"fisheye","px":1,"py":1,"u0":1,"v0":1})", "a", ""); }),
      HasSubstr("ViSP's 'fisheye' is not supported"));
  EXPECT_THAT(error_of([] { parse_camera_text(R"({"u0":1,"px":)", "a", ""); }),
              HasSubstr("is not complete JSON"));
  EXPECT_THAT(error_of([] { parse_camera_text(R"({"px":1,"py":1,"u0":1,"v0":1})", "a", ""); }),
              HasSubstr("has no 'model'"));
  const std::string deep(300000, '[');
  EXPECT_THAT(error_of([&] { parse_camera_text("{\"u0\":" + deep, "a", ""); }), HasSubstr("JSON"));
}

// Opening a pipe would wait for somebody who writes into it.
TEST(CameraDialects, APipeIsRefused) {
  test::TempFolder folder;
  const std::string pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(error_of([&] { read_camera_file(pipe); }), HasSubstr("it is a device or a pipe, not a file"));
}

// ---- what is refused ----

struct BadDialect {
  const char* name;
  std::string text;
  const char* message;
};

class RefusedDialect : public ::testing::TestWithParam<BadDialect> {};

TEST_P(RefusedDialect, IsReportedInOneLine) {
  const std::string message = error_of([] { parse_camera(GetParam().text, "cam"); });
  EXPECT_THAT(message, HasSubstr(GetParam().message));
  EXPECT_EQ(message.rfind("cam", 0), 0u) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

std::string kalibr_pair(const std::string& model, const std::string& intrinsics, const std::string& lens) {
  return "cam0:\n  camera_model: " + model + "\n  intrinsics: " + intrinsics +
         "\n  distortion_model: " + lens + "\n  distortion_coeffs: [0, 0, 0, 0]\n  resolution: [640, 480]\n";
}

std::string colmap_one(int model) {
  return test::bytes_of<uint64_t>(1) + test::bytes_of<uint32_t>(1) + test::bytes_of<int32_t>(model) +
         test::bytes_of<uint64_t>(640) + test::bytes_of<uint64_t>(480);
}

const std::string kStella =
    "Camera:\n  setup: monocular\n  model: equirectangular\n  cols: 640\n  rows: 320\n  fx: 1\n  fy: 1\n  "
    "cx: "
    "1\n  cy: 1\n";

INSTANTIATE_TEST_SUITE_P(
    All, RefusedDialect,
    ::testing::Values(
        BadDialect{
            "kalibr_omni_equidistant", kalibr_pair("omni", "[1.5, 250, 251, 321, 238]", "equidistant"),
            "distortion_model equidistant does not go with camera_model omni; calibrate as omni-radtan"},
        BadDialect{"kalibr_ds_radtan", kalibr_pair("ds", "[0.2, 0.6, 250, 251, 321, 238]", "radtan"),
                   "does not go with camera_model double_sphere"},
        BadDialect{"kalibr_ds_of_four", kalibr_pair("ds", "[250, 251, 321, 238]", "none"),
                   "intrinsics holds 4 numbers; write xi, alpha, fx, fy, cx, cy"},
        BadDialect{"orb_type",
                   "Camera.type: \"Fisheye62\"\nCamera1.fx: 500\nCamera1.fy: 500\nCamera1.cx: "
                   "320\nCamera1.cy: 240\n",
                   "the camera is 'Fisheye62', which is not supported"},
        BadDialect{"orb_slip",
                   "Camera.fx: 500\nCamera.fy: 500\nCamera.cx: 320\nCamera.cy: 240\nCamera.widht: 640\n",
                   "line 5: unknown key 'camera.widht'; did you mean 'camera.width'?"},
        BadDialect{"orb_missing", "Camera.fx: 500\nCamera.fy: 500\nCamera.cx: 320\n",
                   "'camera.cy' is missing"},
        BadDialect{"orb_no_size", "Camera.fx: 500\nCamera.fy: 500\nCamera.cx: 320\nCamera.cy: 240\n",
                   "the image size is missing"},
        BadDialect{"stella_equirectangular", kStella, "the camera is 'equirectangular'"},
        BadDialect{"vins_scaramuzza", "model_type: SCARAMUZZA\nimage_width: 640\n",
                   "model_type 'SCARAMUZZA' is not supported; calibrate as"},
        BadDialect{"vins_missing", "model_type: MEI\nimage_width: 640\n",
                   "'projection_parameters.gamma1' is missing"},
        BadDialect{"basalt_type",
                   "{\"value0\": {\"intrinsics\": [{\"camera_type\": \"kb5\"}], \"resolution\": [[1, "
                   "1]]}}",
                   "camera_type 'kb5' is not supported; did you mean 'kb4'?"},
        BadDialect{"basalt_missing",
                   "{\"value0\": {\"intrinsics\": [{\"camera_type\": \"ds\", \"intrinsics\": "
                   "{\"fx\": 1}}], \"resolution\": [[1, 1]]}}",
                   "cam, cam0: has no 'fy'"},
        BadDialect{"basalt_torn", "{\"value0\": {\"intrinsics\": [", "is not complete JSON"},
        BadDialect{"basalt_sizes", "{\"value0\": {\"intrinsics\": [{}], \"resolution\": []}}",
                   "'resolution'"},
        BadDialect{"other_json", "{\"cameras\": []}", "is JSON, but no calibration of Basalt"},
        BadDialect{"colmap_thin_prism",
                   "1 THIN_PRISM_FISHEYE 640 480 190 191 321 238 0.01 0.02 0.001 0 -0.03 0.004 0 0\n",
                   "has tangential terms"},
        BadDialect{
            "colmap_rad_tan",
            "# CAMERA_ID\n1 RAD_TAN_THIN_PRISM_FISHEYE 640 480 190 191 321 238 0 0 0 0 0 0 0 0 0 0 0 0\n",
            "RAD_TAN_THIN_PRISM_FISHEYE is not supported; reconstruct with"},
        BadDialect{"colmap_unknown", "# CAMERA_ID, MODEL\n1 DIVISION 640 480 500 320 240 0.1\n",
                   "'DIVISION' is not"},
        BadDialect{"colmap_count", "1 OPENCV 640 480 500 500 320 240\n", "OPENCV has 4 parameters"},
        BadDialect{"colmap_bin_torn", test::colmap_binary().substr(0, 90), "cameras.bin ends early"},
        BadDialect{"colmap_bin_model", colmap_one(55), "model number 55 is not known"},
        BadDialect{"colmap_bin_longer", test::colmap_binary() + "x", "more follows behind the last camera"},
        BadDialect{"dso_count", "FOV 0.3 0.4 0.5 0.5\n640 480\n",
                   "has 4 numbers; write DSO's FOV fx fy cx cy omega"},
        BadDialect{"dso_angle", "FOV 250 251 321 238 5\n640 480\n",
                   "the angle of the FOV lens is not between"},
        BadDialect{"mrpt_missing", "[CAMERA_PARAMS]\nresolution = [640 480]\n", "'fx' is missing"},
        BadDialect{"mrpt_slip", "[CAMERA_PARAMS]\nresolutoin = [640 480]\n", "did you mean 'resolution'?"},
        BadDialect{"mrpt_lens", "[CAMERA_PARAMS]\ndistortion = mei\n", "distortion 'mei' is not supported"},
        BadDialect{"mrpt_twice", "[CAMERA_PARAMS]\nfx = 1\nfx = 2\n", "line 3: the key 'fx' is given twice"},
        BadDialect{"visp_type",
                   "<root><camera><name>C</name><model><type>ProjWithKannalaBrandtDistortion</type></model></"
                   "camera></"
                   "root>",
                   "ViSP's 'ProjWithKannalaBrandtDistortion' is not supported; save the camera as "
                   "perspectiveProjWithDistortion"},
        BadDialect{
            "visp_missing",
            "<root><camera><model><type>perspectiveProjWithDistortion</type><px>500</px></model></camera></"
            "root>",
            "has no <py>"},
        BadDialect{"visp_torn", "<root><camera>", "is not complete XML"},
        BadDialect{"xml_entities", "<!DOCTYPE a [<!ENTITY b \"c\">]><root/>", "has a document type"},
        BadDialect{"other_xml", "<html><body/></html>", "is XML of <html>, no calibration"},
        BadDialect{"opencv_xml_empty", "<opencv_storage><a>1</a></opencv_storage>",
                   "not a camera file of a known"},
        BadDialect{"png", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16),
                   "is a PNG image, not a calibration"},
        BadDialect{"binary", std::string("\x01\0\x02\x03", 4), "is not text, not a calibration"}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace edgevo
