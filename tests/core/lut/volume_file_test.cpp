#include "core/lut/volume_file.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/lut/cube_file.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {

std::string volumes_json(const std::string& volume) {
  return R"({"format": "plenolab-volumes", "version": 1, "volumes": [)" + volume + "]}";
}

std::string refused(const std::string& volume) {
  return message_of([&] { parse_volumes(volumes_json(volume), "v.json"); });
}

TEST(VolumeFile, ReadsBoxesAndTheirTables) {
  const TemporaryFolder folder;
  write_lut(folder.path() / "luts" / "hall.cube", identity_lut(3));
  write_lut(folder.path() / "yard.png", identity_lut(4));
  write_text_file(
      folder.path() / "v.json",
      volumes_json(R"({"name": "hall", "min": [-2, 0, -2], "max": [2, 8, 2.5], "blend_radius_m": 1,
                                   "weight": 0.5, "lut": "luts/hall.cube"},
                                  {"name": "yard", "min": [2, 0, -2], "max": [6, 8, 2], "lut": "yard.png"})"));
  const LoadedVolumes loaded = read_volumes(folder.path() / "v.json");
  ASSERT_EQ(loaded.volumes.size(), 2u);
  EXPECT_EQ(loaded.volumes[0].max, (Point3{2, 8, 2.5}));
  EXPECT_EQ(loaded.volumes[0].weight, 0.5);
  EXPECT_EQ(loaded.volumes[1].weight, 1);
  EXPECT_EQ(loaded.volumes[1].blend_radius_m, 0);
  EXPECT_EQ(loaded.tables[0].size, 3);
  EXPECT_EQ(loaded.tables[1].size, 4);
  EXPECT_EQ(loaded.background.size, kDefaultLutSize);
  EXPECT_EQ(loaded.files.size(), 2u);
}

TEST(VolumeFile, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(refused(R"({"name": "a", "min": [0, 0], "max": [1, 1, 1], "lut": "a.cube"})"),
            "v.json: \"volumes[0].min\" must be a list of three numbers (metres)");
  EXPECT_EQ(refused(R"({"name": "a", "min": [0, 0, "x"], "max": [1, 1, 1], "lut": "a.cube"})"),
            "v.json: \"volumes[0].min\" must hold finite numbers");
  EXPECT_EQ(refused(R"({"name": "a", "min": [0, 2, 0], "max": [1, 1, 1], "lut": "a.cube"})"),
            "v.json: volume 'a' reaches from 2 to 1 m along axis 2, which is no range");
  EXPECT_EQ(refused(R"({"name": "a", "min": [0, 0, 0], "max": [1, 1, 1], "lut": "a.cube", "wieght": 1})")
                .find("v.json"),
            0u);
  EXPECT_EQ(refused(R"({"name": "a", "min": [0, 0, 0], "max": [1, 1, 1], "weight": 2, "lut": "a.cube"})"),
            "v.json: volume 'a': the weight is 2 but must lie in [0, 1]");
  EXPECT_NE(refused(R"({"name": "a", "min": [0, 0, 0], "max": [1, 1, 1]})"), "");
  EXPECT_THROW(parse_volumes("[]", "v.json"), InputError);
  EXPECT_THROW(parse_volumes(R"({"format": "plenolab-volumes", "version": 2, "volumes": []})", "v.json"),
               InputError);
  EXPECT_TRUE(parse_volumes(volumes_json(""), "v.json").volumes.empty());
}

TEST(VolumeFile, TheIdentityOfTheBackgroundTakesTheDomainOfTheTables) {
  const TemporaryFolder folder;
  write_lut(folder.path() / "wide.cube", identity_lut(3, {0, 0, 0}, {2, 2, 2}));
  write_text_file(folder.path() / "v.json",
                  volumes_json(R"({"name": "a", "min": [0, 0, 0], "max": [1, 1, 1], "lut": "wide.cube"})"));
  const LoadedVolumes loaded = read_volumes(folder.path() / "v.json");
  EXPECT_EQ(blend_volumes({{0.5}, 0.5}, loaded.tables, loaded.background).domain_max, (Rgb{2, 2, 2}));
}

TEST(VolumeFile, RefusesTwoVolumesOfOneName) {
  const std::string one = R"({"name": "hall", "min": [0, 0, 0], "max": [1, 1, 1], "lut": "a.cube"})";
  EXPECT_EQ(refused(one + ", " + one), "v.json: two volumes are named 'hall'");
}

TEST(VolumeFile, WhatIsWrittenReadsBack) {
  const VolumeScene scene{
      {{"hall \"A\"", {-2, 0, -2.5}, {2, 8, 2}, 1, 0.5}, {"point", {1, 1, 1}, {1, 1, 1}, 0, 1}},
      {"hall.cube", "p.png"},
      "neutral.cube"};
  const VolumeScene again = parse_volumes(volumes_text(scene), "again");
  ASSERT_EQ(again.volumes.size(), 2u);
  EXPECT_EQ(again.volumes[0].name, "hall \"A\"");
  EXPECT_EQ(again.volumes[0].min, scene.volumes[0].min);
  EXPECT_EQ(again.volumes[0].max, scene.volumes[0].max);
  EXPECT_EQ(again.volumes[0].blend_radius_m, 1);
  EXPECT_EQ(again.volumes[0].weight, 0.5);
  EXPECT_EQ(again.tables, scene.tables);
  EXPECT_EQ(again.background, "neutral.cube");
  EXPECT_THROW(volumes_text({{{"turned", {1, 0, 0}, {0, 1, 1}, 0, 1}}, {"a.cube"}, ""}), InputError);
}

}  // namespace
}  // namespace plenolab
