#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/base/random.h"
#include "core/io/bytes.h"
#include "core/io/exr.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

SceneImage random_image(int width, int height) {
  SceneImage image(width, height);
  RandomStream random(7, 1, 0);
  for (Rgb& c : image.pixels())
    c = {random.next_float(), 100 * random.next_float(), 1e4f * random.next_float()};
  return image;
}

// A file with one float channel "Z" that holds its column number, in an arbitrary data window.
void write_windowed(const std::filesystem::path& path, Imath::Box2i window, int sampling = 1) {
  Imf::Header header(Imath::Box2i({0, 0}, {9, 9}), window);
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT, sampling, sampling));
  const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
  std::vector<float> data(static_cast<std::size_t>(width * height));
  for (int i = 0; i < width * height; ++i) data[static_cast<std::size_t>(i)] = static_cast<float>(i % width);
  Imf::FrameBuffer buffer;
  buffer.insert("Z", Imf::Slice::Make(Imf::FLOAT, data.data(), window, 0, 0, sampling, sampling));
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(buffer);
  file.writePixels(height);
}

TEST(Exr, FloatImagesWithDisparityAndMetadataComeBackExactly) {
  const TemporaryFolder folder;
  const SceneImage image = random_image(37, 23);
  Plane<float> disparity(37, 23);
  for (std::size_t i = 0; i < disparity.size(); ++i) disparity.pixels()[i] = static_cast<float>(i) / 3;
  for (const ExrCompression compression :
       {ExrCompression::kNone, ExrCompression::kZip, ExrCompression::kPiz}) {
    ExrWriteOptions options;
    options.colour_type = ExrPixelType::kFloat;
    options.compression = compression;
    options.string_attributes["scene"] = "cellar";
    options.float_attributes["spacing_m"] = 0.25f;
    const auto path = folder.path() / "new" / "image.exr";
    write_exr(path, image, {{"disparity", &disparity}}, options);
    EXPECT_EQ(read_exr_image(path), image);
    EXPECT_EQ(read_exr_channels(path, {"disparity"}).at(0), disparity);
    const ExrPartInfo part = read_exr_header(path).at(0);
    EXPECT_EQ(part.string_attributes.at("scene"), "cellar");
    EXPECT_EQ(part.float_attributes.at("spacing_m"), 0.25f);
    EXPECT_EQ(part.width, 37);
    EXPECT_EQ(part.channels.size(), 4u);
  }
}

TEST(Exr, HalfImagesKeepElevenBitsAndEveryNonFiniteValue) {
  const TemporaryFolder folder;
  SceneImage image = random_image(8, 8);
  image.at(0, 0) = {kInf, -kInf, std::nanf("")};
  image.at(1, 0) = {65504, -65504, 0};
  write_exr(folder.path() / "a.exr", image);
  const SceneImage back = read_exr_image(folder.path() / "a.exr");
  EXPECT_EQ(back.at(0, 0).r, kInf);
  EXPECT_EQ(back.at(0, 0).g, -kInf);
  EXPECT_TRUE(std::isnan(back.at(0, 0).b));
  EXPECT_EQ(back.at(1, 0), image.at(1, 0));
  for (int x = 2; x < 8; ++x) EXPECT_NEAR(back.at(x, 3).b, image.at(x, 3).b, image.at(x, 3).b / 2048);
}

TEST(Exr, RadianceBeyondHalfIsRefusedInsteadOfClamped) {
  const TemporaryFolder folder;
  SceneImage image(2, 2);
  image.at(1, 0).g = 70000;
  const std::string message = message_of([&] { write_exr(folder.path() / "a.exr", image); });
  EXPECT_NE(message.find("70000 at pixel (1, 0)"), std::string::npos) << message;
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Exr, ImagesOfOnePixelColumnAndRowWork) {
  const TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 40}, {40, 1}}) {
    const SceneImage image = random_image(width, height);
    ExrWriteOptions options;
    options.colour_type = ExrPixelType::kFloat;
    write_exr(folder.path() / "a.exr", image, {}, options);
    EXPECT_EQ(read_exr_image(folder.path() / "a.exr"), image);
  }
}

TEST(Exr, AnyDataWindowIsRead) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.exr";
  for (const Imath::Box2i& window :
       {Imath::Box2i({-5, -7}, {4, 3}), Imath::Box2i({1000, 2000}, {1009, 2010})}) {
    write_windowed(path, window);
    const Plane<float> plane = read_exr_channels(path, {"Z"}).at(0);
    ASSERT_EQ(plane.width(), 10);
    ASSERT_EQ(plane.height(), 11);
    EXPECT_EQ(plane.at(9, 10), 9);
    EXPECT_EQ(plane.at(0, 0), 0);
  }
}

TEST(Exr, TilesAreRead) {
  const TemporaryFolder folder;
  const auto path = (folder.path() / "a.exr").string();
  std::vector<float> data(50 * 30);
  for (std::size_t i = 0; i < data.size(); ++i) data[i] = static_cast<float>(i);
  {
    Imf::Header header(50, 30);
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    header.setTileDescription(Imf::TileDescription(16, 8, Imf::ONE_LEVEL));
    Imf::TiledOutputFile file(path.c_str(), header);
    Imf::FrameBuffer buffer;
    buffer.insert("Y", Imf::Slice::Make(Imf::FLOAT, data.data(), header.dataWindow()));
    file.setFrameBuffer(buffer);
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
  }
  const SceneImage image = read_exr_image(path);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 50; ++x) EXPECT_EQ(image.at(x, y).g, static_cast<float>(y * 50 + x));
}

TEST(Exr, TheFirstPartHoldingTheChannelsIsTaken) {
  const TemporaryFolder folder;
  const auto path = (folder.path() / "a.exr").string();
  std::vector<float> data(12, 4.5f);
  {
    Imf::Header colour(4, 3), depth(4, 3);
    colour.setName("colour");
    colour.setType(Imf::SCANLINEIMAGE);
    colour.channels().insert("R", Imf::Channel(Imf::FLOAT));
    depth.setName("depth");
    depth.setType(Imf::SCANLINEIMAGE);
    depth.channels().insert("Z", Imf::Channel(Imf::FLOAT));
    const Imf::Header headers[2] = {colour, depth};
    Imf::MultiPartOutputFile file(path.c_str(), headers, 2);
    for (int i = 0; i < 2; ++i) {
      Imf::OutputPart part(file, i);
      Imf::FrameBuffer buffer;
      buffer.insert(i == 0 ? "R" : "Z", Imf::Slice::Make(Imf::FLOAT, data.data(), headers[i].dataWindow()));
      part.setFrameBuffer(buffer);
      part.writePixels(3);
    }
  }
  EXPECT_EQ(read_exr_channels(path, {"Z"}).at(0).at(3, 2), 4.5f);
  EXPECT_EQ(read_exr_header(path).size(), 2u);
  EXPECT_THROW(read_exr_channels(path, {"R", "Z"}), InputError);
}

TEST(Exr, SubsampledChannelsAreRefusedByName) {
  const TemporaryFolder folder;
  write_windowed(folder.path() / "a.exr", Imath::Box2i({0, 0}, {9, 9}), 2);
  const std::string message = message_of([&] { read_exr_channels(folder.path() / "a.exr", {"Z"}); });
  EXPECT_NE(message.find("channel Z of"), std::string::npos) << message;
}

TEST(Exr, AMissingChannelIsNamedWithThoseThereAre) {
  const TemporaryFolder folder;
  write_exr(folder.path() / "a.exr", random_image(3, 3));
  const std::string message = message_of([&] { read_exr_channels(folder.path() / "a.exr", {"Depth.Z"}); });
  EXPECT_NE(message.find("Depth.Z; it holds B, G, R"), std::string::npos) << message;
}

TEST(Exr, EveryTruncationIsAnErrorAndNeverZeros) {
  const TemporaryFolder folder;
  ExrWriteOptions options;
  options.colour_type = ExrPixelType::kFloat;
  write_exr(folder.path() / "a.exr", random_image(20, 40), {}, options);
  const std::vector<std::byte> bytes = read_bytes(folder.path() / "a.exr", 1 << 20);
  for (std::size_t size = 0; size < bytes.size(); size += 7)
    EXPECT_THROW(parse_exr_image(std::span(bytes).first(size), "a.exr"), InputError) << size;
}

TEST(Exr, EveryDamagedHeaderByteGivesAnErrorOrAnImage) {
  const TemporaryFolder folder;
  write_exr(folder.path() / "a.exr", random_image(9, 17));
  const std::vector<std::byte> good = read_bytes(folder.path() / "a.exr", 1 << 20);
  int errors = 0;
  for (std::size_t at = 0; at < std::min<std::size_t>(good.size(), 420); ++at)
    for (const int value : {0x00, 0x7f, 0x80, 0xff}) {
      std::vector<std::byte> bytes = good;
      bytes[at] = static_cast<std::byte>(value);
      try {
        const SceneImage image = parse_exr_image(bytes, "a.exr");
        EXPECT_LE(image.size(), 1u << 20);
      } catch (const InputError& error) {
        ++errors;
        EXPECT_NE(std::string(error.what()).find("a.exr"), std::string::npos);
      }
    }
  EXPECT_GT(errors, 500);
}

TEST(Exr, AbsurdSizesAreRefusedBeforeAnythingIsAllocated) {
  const TemporaryFolder folder;
  write_exr(folder.path() / "a.exr", random_image(4, 4));
  std::vector<std::byte> bytes = read_bytes(folder.path() / "a.exr", 1 << 20);
  const std::string key = std::string("dataWindow") + '\0' + "box2i" + '\0';
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t box = text.find(key) + key.size() + 4;
  for (const auto& [right, bottom] : {std::pair{1 << 29, 0}, {0, 1 << 29}, {40000, 40000}, {3, 1 << 20}}) {
    const std::int32_t window[4] = {0, 0, right, bottom};
    std::memcpy(bytes.data() + box, window, sizeof window);
    EXPECT_THROW(parse_exr_image(bytes, "a.exr"), InputError) << right << " " << bottom;
  }
  EXPECT_THROW(read_exr_image(folder.path() / "a.exr", {.max_pixels = 15}), InputError);
  EXPECT_EQ(read_exr_image(folder.path() / "a.exr", {.max_pixels = 16}).size(), 16u);
}

TEST(Exr, AttributesWhoseStatedSizeIsNotThatOfTheirTypeAreRefusedByName) {
  const TemporaryFolder folder;
  write_exr(folder.path() / "a.exr", random_image(4, 4));
  const std::vector<std::byte> good = read_bytes(folder.path() / "a.exr", 1 << 20);
  const std::string_view text(reinterpret_cast<const char*>(good.data()), good.size());
  for (const auto& [name, type] : {std::pair<std::string, std::string>{"pixelAspectRatio", "float"},
                                   {"screenWindowCenter", "v2f"},
                                   {"channels", "chlist"}}) {
    const std::string key = name + '\0' + type + '\0';
    const std::size_t size_at = text.find(key) + key.size();
    std::vector<std::byte> bytes = good;
    std::int32_t size = 0;
    std::memcpy(&size, bytes.data() + size_at, 4);
    size += 3;
    std::memcpy(bytes.data() + size_at, &size, 4);
    bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(size_at) + 4 + size - 3, 3, std::byte{0x7f});
    EXPECT_NE(message_of([&] { parse_exr_image(bytes, "a.exr"); }).find(name), std::string::npos) << name;
  }
}

TEST(Exr, ExtraChannelsOfAnotherSizeOrReservedNamesAreRefused) {
  const TemporaryFolder folder;
  const Plane<float> small(2, 2), equal(3, 3);
  EXPECT_THROW(write_exr(folder.path() / "a.exr", random_image(3, 3), {{"Z", &small}}), InputError);
  EXPECT_THROW(write_exr(folder.path() / "a.exr", random_image(3, 3), {{"R", &equal}}), InputError);
  ExrWriteOptions options;
  options.string_attributes["compression"] = "mine";
  EXPECT_THROW(write_exr(folder.path() / "a.exr", random_image(3, 3), {}, options), InputError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

// The folder of broken files from OpenEXR's own fuzzing, where there is a copy of it: see
// tests/data/README.md.
TEST(Exr, CollectedDamagedFilesGiveOneSentenceOrAnImageWithinBoundedMemory) {
  const char* outside = std::getenv("PLENOLAB_OUTSIDE_DATA");
  if (!outside) GTEST_SKIP() << "set PLENOLAB_OUTSIDE_DATA to a folder that holds damaged-exr/";
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(outside) / "damaged-exr")) {
    std::string result = "no image";
    try {
      const std::vector<ExrPartInfo> parts = read_exr_header(entry.path());
      for (const ExrPartInfo& part : parts)
        for (const ExrChannelInfo& channel : part.channels) {
          const Plane<float> plane = read_exr_channels(entry.path(), {channel.name}).at(0);
          result = fmt::format("{} × {}", plane.width(), plane.height());
        }
    } catch (const InputError& error) {
      result = error.what();
      EXPECT_EQ(result.find('\n'), std::string::npos) << result;
      EXPECT_NE(result.find(entry.path().filename().string()), std::string::npos) << result;
    }
    std::printf("%s\n", result.c_str());
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 1 << 20) << "KiB";
}

}  // namespace
}  // namespace plenolab
