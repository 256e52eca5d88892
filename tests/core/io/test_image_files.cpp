#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/base/random.h"
#include "core/io/bytes.h"
#include "core/io/image_file.h"
#include "core/io/pfm.h"
#include "core/io/radiance_hdr.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

std::string float_bytes(std::initializer_list<float> values, bool big_endian = false) {
  std::string out;
  for (const float v : values) {
    char raw[4];
    std::memcpy(raw, &v, 4);
    out += big_endian ? std::string{raw[3], raw[2], raw[1], raw[0]} : std::string(raw, 4);
  }
  return out;
}

SceneImage random_image(int width, int height, float scale = 1) {
  SceneImage image(width, height);
  RandomStream random(3, 1, 0);
  for (Rgb& c : image.pixels())
    c = {scale * random.next_float(), scale * random.next_float(), scale * random.next_float()};
  return image;
}

TEST(Pfm, RowsRunBottomUpInBothByteOrders) {
  for (const bool big : {false, true}) {
    const std::string file =
        fmt::format("Pf\n2 2\n{}\n", big ? "1.0" : "-1.0") + float_bytes({1, 2, 3, 4}, big);
    const PfmImage image = parse_pfm(bytes_of(file), "a.pfm");
    ASSERT_FALSE(image.is_colour);
    EXPECT_EQ(image.grey.at(0, 0), 3);
    EXPECT_EQ(image.grey.at(1, 0), 4);
    EXPECT_EQ(image.grey.at(0, 1), 1);
  }
}

TEST(Pfm, PlanesAndImagesComeBackExactlyWithNonFiniteValues) {
  const TemporaryFolder folder;
  Plane<float> plane(3, 2, 0.5f);
  plane.at(2, 1) = -std::numeric_limits<float>::infinity();
  plane.at(0, 0) = std::numeric_limits<float>::denorm_min();
  write_pfm(folder.path() / "a.pfm", plane);
  EXPECT_EQ(read_pfm_plane(folder.path() / "a.pfm"), plane);
  const SceneImage image = random_image(5, 7, 1e9f);
  write_scene_image(folder.path() / "b.pfm", image);
  EXPECT_EQ(read_scene_image(folder.path() / "b.pfm"), image);
  EXPECT_THROW(read_pfm_plane(folder.path() / "b.pfm"), InputError);
}

TEST(Pfm, DamagedFilesAreRefused) {
  const std::string data = float_bytes({1, 2, 3, 4});
  for (const std::string& file : std::initializer_list<std::string>{
           "", "P", "Pf", "P6\n2 2\n255\n" + data, "Pf\n2 2\n-1.0\n" + data.substr(1),
           "Pf\n2 2\n-1.0\n" + data + "x", "Pf\n2 -2\n-1.0\n" + data, "Pf\n2 2\n0\n" + data,
           "Pf\n2 2\nnan\n" + data, "Pf\n2 x\n-1\n" + data, "Pf\n2147483647 2147483647\n-1\n" + data,
           "Pf\n99999999999 1\n-1\n" + data, "PF\n2 2\n-1\n" + data})
    EXPECT_THROW(parse_pfm(bytes_of(file), "a.pfm"), InputError) << file.substr(0, 20);
}

std::string hdr_header(const std::string& size, const std::string& extra = "") {
  return "#?RADIANCE\n" + extra + "FORMAT=32-bit_rle_rgbe\n\n" + size + "\n";
}

TEST(RadianceHdr, AMantissaStandsForItsFractionOfThePowerOfTwo) {
  const std::string file =
      hdr_header("-Y 1 +X 2") + std::string("\x80\x40\x20\x81", 4) + std::string("\xff\x01\x02\x00", 4);
  const SceneImage image = parse_radiance_hdr(bytes_of(file), "a.hdr");
  EXPECT_EQ(image.at(0, 0), (Rgb{1.0f, 0.5f, 0.25f}));
  EXPECT_EQ(image.at(1, 0), (Rgb{0, 0, 0}));
}

TEST(RadianceHdr, ExposureLinesAreDividedOut) {
  const std::string file =
      hdr_header("-Y 1 +X 1", "EXPOSURE=2\nEXPOSURE= 4\n") + std::string("\x80\x40\x20\x81", 4);
  EXPECT_EQ(parse_radiance_hdr(bytes_of(file), "a.hdr").at(0, 0).r, 0.125f);
}

TEST(RadianceHdr, OldRunsRepeatThePixelBefore) {
  const std::string file =
      hdr_header("-Y 1 +X 4") + std::string("\x80\x80\x80\x81", 4) + std::string("\x01\x01\x01\x03", 4);
  const SceneImage image = parse_radiance_hdr(bytes_of(file), "a.hdr");
  for (int x = 0; x < 4; ++x) EXPECT_EQ(image.at(x, 0).g, 1.0f);
}

TEST(RadianceHdr, MirroredOrientationsAreTurnedAndTransposedOnesRefused) {
  const std::string data = std::string("\x80\x80\x80\x81", 4) + std::string("\x80\x80\x80\x82", 4);
  EXPECT_EQ(parse_radiance_hdr(bytes_of(hdr_header("-Y 1 -X 2") + data), "a").at(0, 0).r, 2.0f);
  EXPECT_EQ(parse_radiance_hdr(bytes_of(hdr_header("+Y 2 +X 1") + data), "a").at(0, 0).r, 2.0f);
  const std::string message =
      message_of([&] { parse_radiance_hdr(bytes_of(hdr_header("+X 2 -Y 1") + data), "a.hdr"); });
  EXPECT_NE(message.find("+X 2 -Y 1"), std::string::npos) << message;
}

TEST(RadianceHdr, ImagesComeBackWithinHalfAMantissaStep) {
  const TemporaryFolder folder;
  for (const int width : {1, 7, 8, 300}) {
    SceneImage image = random_image(width, 5, 1e4f);
    for (int x = 0; x < width; ++x) image.at(x, 2) = {0.25f, 0.25f, 0};
    image.at(0, 4) = {1e-30f, 1e-30f, 1e30f};
    write_scene_image(folder.path() / "a.hdr", image);
    const SceneImage back = read_scene_image(folder.path() / "a.hdr");
    ASSERT_EQ(back.width(), width);
    for (std::size_t i = 0; i < image.size(); ++i) {
      const Rgb a = image.pixels()[i], b = back.pixels()[i];
      const float step = std::max({a.r, a.g, a.b}) / 128;
      EXPECT_NEAR(a.r, b.r, step / 2);
      EXPECT_NEAR(a.b, b.b, step / 2);
    }
    EXPECT_EQ(back.at(width - 1, 2), (Rgb{0.25f, 0.25f, 0}));
  }
}

TEST(RadianceHdr, ValuesThatRoundUpToTheNextPowerOfTwoKeepTheirSize) {
  const TemporaryFolder folder;
  write_radiance_hdr(folder.path() / "a.hdr", SceneImage(1, 1, {0.9999f, 0.9999f, 0.9999f}));
  EXPECT_EQ(read_radiance_hdr(folder.path() / "a.hdr").at(0, 0).r, 1.0f);
}

TEST(RadianceHdr, ValuesRgbeCannotHoldAreRefused) {
  const TemporaryFolder folder;
  for (const float v : {-1.0f, std::nanf(""), std::numeric_limits<float>::infinity(), 3e38f})
    EXPECT_THROW(write_radiance_hdr(folder.path() / "a.hdr", SceneImage(1, 1, {0, v, 0})), InputError);
}

TEST(RadianceHdr, EveryTruncationAndWrongHeaderIsAnError) {
  const TemporaryFolder folder;
  write_radiance_hdr(folder.path() / "a.hdr", random_image(20, 6));
  const std::vector<std::byte> bytes = read_bytes(folder.path() / "a.hdr", 1 << 20);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(parse_radiance_hdr(std::span(bytes).first(size), "a.hdr"), InputError) << size;
  const std::string pixel("\x80\x40\x20\x81", 4);
  EXPECT_THROW(parse_radiance_hdr(bytes_of("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n" + pixel), "a"),
               InputError);
  EXPECT_THROW(parse_radiance_hdr(bytes_of(hdr_header("-Y 1 +X 1", "EXPOSURE=0\n") + pixel), "a"),
               InputError);
  EXPECT_THROW(parse_radiance_hdr(bytes_of(hdr_header("-Y 16000 +X 16000") + pixel), "a"), InputError);
  EXPECT_THROW(parse_radiance_hdr(bytes_of(hdr_header("-Y 1 +X 4") + "\x01\x01\x01\x03"), "a"), InputError);
}

TEST(Png, CodesComeBackExactlyInBothDepths) {
  const TemporaryFolder folder;
  DisplayImage image(256, 2);
  for (int x = 0; x < 256; ++x) {
    image.at(x, 0) = {static_cast<float>(x) / 255, static_cast<float>(255 - x) / 255, 0};
    image.at(x, 1) = {static_cast<float>(x * 257) / 65535, 0, static_cast<float>(x) / 65535};
  }
  write_display_image(folder.path() / "a.png", image, PngDepth::k16Bit);
  const DisplayImage back = read_display_image(folder.path() / "a.png");
  for (int x = 0; x < 256; ++x) {
    EXPECT_FLOAT_EQ(back.at(x, 0).g, image.at(x, 0).g);
    EXPECT_EQ(back.at(x, 1), image.at(x, 1));
  }
  write_display_image(folder.path() / "b.png", image);
  const DisplayImage eight = read_display_image(folder.path() / "b.png");
  for (int x = 0; x < 256; ++x) EXPECT_EQ(eight.at(x, 0), image.at(x, 0));
}

TEST(Png, ValuesOutsideTheRangeAreRefusedWithTheirPixel) {
  const TemporaryFolder folder;
  DisplayImage image(3, 3);
  for (const float v : {1.01f, -0.01f, std::nanf("")}) {
    image.at(2, 1).b = v;
    const std::string message = message_of([&] { write_display_image(folder.path() / "a.png", image); });
    EXPECT_NE(message.find("pixel (2, 1)"), std::string::npos) << message;
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Png, TruncatedFilesAreErrors) {
  const TemporaryFolder folder;
  DisplayImage image(40, 40);
  RandomStream random(1, 2, 3);
  for (Rgb& c : image.pixels()) c = {random.next_float(), random.next_float(), random.next_float()};
  write_display_image(folder.path() / "a.png", image);
  const std::vector<std::byte> bytes = read_bytes(folder.path() / "a.png", 1 << 20);
  for (const double share : {0.0, 0.001, 0.01, 0.3, 0.7, 0.95}) {
    const auto size = static_cast<std::size_t>(share * static_cast<double>(bytes.size()));
    write_bytes(folder.path() / "b.png", std::span(bytes).first(size));
    EXPECT_THROW(read_display_image(folder.path() / "b.png"), InputError) << share;
  }
}

TEST(ImageFile, WrongExtensionsAreAnsweredWithTheRightOnes) {
  const TemporaryFolder folder;
  const std::filesystem::path png = folder.path() / "photo.png", exr = folder.path() / "photo.exr";
  write_text_file(png, "not looked at");
  write_text_file(exr, "not looked at");
  const std::string scene = message_of([&] { read_scene_image(png); });
  EXPECT_NE(scene.find(".exr, .hdr"), std::string::npos) << scene;
  const std::string display = message_of([&] { read_display_image(exr); });
  EXPECT_NE(display.find(".png"), std::string::npos) << display;
  const std::string missing = message_of([&] { read_scene_image(folder.path() / "typo"); });
  EXPECT_NE(missing.find("does not exist"), std::string::npos) << missing;
  EXPECT_THROW(write_scene_image(folder.path() / "a.jpg", SceneImage(1, 1)), InputError);
  EXPECT_THROW(write_display_image(folder.path() / "a.hdr", DisplayImage(1, 1)), InputError);
  EXPECT_THROW(read_scene_image(folder.path() / "missing.exr"), InputError);
  EXPECT_THROW(read_scene_image(folder.path()), InputError);
}

}  // namespace
}  // namespace plenolab
