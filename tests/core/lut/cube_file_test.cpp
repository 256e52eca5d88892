// The .cube format against its specification, and strips of images.
#include "core/lut/cube_file.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/base/random.h"
#include "core/io/image_file.h"
#include "core/lut/strip_file.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;

// Two nodes along each axis as in the specification's example: red runs fastest.
const std::string kNodes = "0 0 0\n1 0 0\n0 .75 0\n1 .75 0\n0 .25 1\n1 .25 1\n0 1 1\n1 1 1\n";

std::string refused(const std::string& text) {
  return message_of([&] { parse_cube(text, "a.cube"); });
}

TEST(CubeFile, ReadsTheExampleOfTheSpecification) {
  // Adobe, Cube LUT Specification 1.0, example of a 3D table with comment, title and domain.
  const Lut lut = parse_cube(
      "# comment lines can be here\nTITLE \"3D LUT example\"\nLUT_3D_SIZE 2\nDOMAIN_MIN 0.0 0.0 0.0\n"
      "DOMAIN_MAX 1.0 1.0 1.0\n" +
          kNodes,
      "a.cube");
  EXPECT_EQ(lut.size, 2);
  EXPECT_EQ(lut.title, "3D LUT example");
  EXPECT_EQ(lut.node(1, 0, 0), (Rgb{1, 0, 0}));
  EXPECT_EQ(lut.node(0, 1, 0), (Rgb{0, 0.75f, 0}));
  EXPECT_EQ(lut.node(0, 0, 1), (Rgb{0, 0.25f, 1}));
}

TEST(CubeFile, ReadsWhatOtherProgramsWrite) {
  std::string text = "\xEF\xBB\xBF\r\n  LUT_3D_SIZE\t2\r\nLUT_3D_INPUT_RANGE -0.5 1.5\r\n";
  for (const char c : kNodes) text += c == '\n' ? std::string(" \r\n") : std::string(1, c);
  text += "\r\n# end";
  const Lut lut = parse_cube(text, "a.cube");
  EXPECT_EQ(lut.domain_min, (Rgb{-0.5f, -0.5f, -0.5f}));
  EXPECT_EQ(lut.domain_max, (Rgb{1.5f, 1.5f, 1.5f}));
  EXPECT_EQ(lut.node(1, 1, 1), (Rgb{1, 1, 1}));
  std::string signs = "LUT_3D_SIZE 2\n+1e0 -2.5E-1 1e-60\n" + kNodes.substr(6);
  EXPECT_EQ(parse_cube(signs, "a.cube").node(0, 0, 0), (Rgb{1, -0.25f, 0}));
}

TEST(CubeFile, WritesWhatReadsBackExactly) {
  Lut lut = bake_lut(6, [](Rgb c) { return Rgb{c.r / 3, -1e-20f + c.g * 1e8f, c.b - 0.1f}; });
  lut.title = "a title, with # and ü";
  lut.domain_min = {-0.1f, 0, 0.3f};
  lut.domain_max = {1, 1.7f, 100};
  const Lut again = parse_cube(cube_text(lut), "a.cube");
  EXPECT_EQ(again.nodes, lut.nodes);
  EXPECT_EQ(again.title, lut.title);
  EXPECT_EQ(again.domain_min, lut.domain_min);
  EXPECT_EQ(again.domain_max, lut.domain_max);
  lut.title = "a \" quote";
  EXPECT_THROW(cube_text(lut), InputError);
}

TEST(CubeFile, WritesOnlyWhatTheSpecificationAllows) {
  const std::string text = cube_text(identity_lut(3));
  EXPECT_EQ(text.substr(0, 14), "LUT_3D_SIZE 3\n");
  EXPECT_EQ(text.find("DOMAIN"), std::string::npos);
  std::size_t lines = 0, longest = 0;
  for (std::size_t start = 0; start < text.size(); ++lines) {
    const std::size_t end = text.find('\n', start);
    longest = std::max(longest, end - start);
    start = end + 1;
  }
  EXPECT_EQ(lines, 28u);
  EXPECT_LE(longest, 250u);
  EXPECT_NE(text.find("\n0.5 0 0\n1 0 0\n0 0.5 0\n"), std::string::npos);
}

TEST(CubeFile, RefusesDamagedFilesInASentence) {
  EXPECT_EQ(refused(""), "a.cube has neither LUT_3D_SIZE nor LUT_1D_SIZE: it is no .cube file");
  EXPECT_EQ(refused("LUT_3D_SIZE 2\n" + kNodes.substr(0, 42)),
            "a.cube is cut off: 42 bytes cannot hold the 8 nodes of LUT_3D_SIZE 2");
  EXPECT_EQ(refused("LUT_3D_SIZE 2\n" + kNodes.substr(0, 50)),
            "a.cube is cut off: it holds 7 of the 8 nodes of LUT_3D_SIZE 2");
  EXPECT_EQ(refused("LUT_3D_SIZE 2\n" + kNodes + "0 0 0\n"),
            "a.cube, line 10: there are more than the 8 nodes of LUT_3D_SIZE 2");
  EXPECT_EQ(refused("LUT_3D_SIZE 2\nnan 0 0\n"),
            "a.cube is cut off: 8 bytes cannot hold the 8 nodes of LUT_3D_SIZE 2");
  EXPECT_EQ(refused("LUT_3D_SIZE 2\n0 nan 0\n" + kNodes), "a.cube, line 2: 'nan' is not finite");
  EXPECT_EQ(refused("LUT_3D_SIZE 2\n0 -inf 0\n" + kNodes), "a.cube, line 2: '-inf' is not finite");
  EXPECT_EQ(refused("LUT_3D_SIZE 2\n0 1e50 0\n" + kNodes),
            "a.cube, line 2: '1e50' does not lie within ±1e+30");
  EXPECT_EQ(refused("LUT_3D_SIZE 2\n0 0x1 0\n" + kNodes), "a.cube, line 2: '0x1' is no number");
  EXPECT_EQ(refused("LUT_3D_SIZE 2\n0 0\n" + kNodes), "a.cube, line 2: a node needs 3 numbers");
  EXPECT_EQ(refused("LUT_3D_SIZE 2\n0 0 0 0\n" + kNodes), "a.cube, line 2: a node has more than 3 numbers");
  EXPECT_EQ(refused("0 0 0\n"), "a.cube, line 1: a node stands before LUT_3D_SIZE or LUT_1D_SIZE");
  EXPECT_EQ(refused("LUT_3D_SIZE 2\nLUT_3D_SIZE 2\n" + kNodes),
            "a.cube, line 2: LUT_3D_SIZE stands there twice");
  EXPECT_EQ(refused("LUT_3D_SIZE 2\n" + kNodes + "TITLE \"late\"\n"),
            "a.cube, line 10: 'TITLE' stands behind the first node");
  EXPECT_EQ(refused("TITLE late\n"), "a.cube, line 1: TITLE needs a text in quotes");
  EXPECT_EQ(refused("LUT_IN_VIDEO_RANGE\n"),
            "a.cube, line 1: 'LUT_IN_VIDEO_RANGE' is no keyword of a .cube file that is understood");
  EXPECT_EQ(refused("LUT_3D_SIZE 2\nDOMAIN_MIN 0 1 0\n" + kNodes),
            "a.cube has a domain whose minimum does not lie below its maximum");
  EXPECT_EQ(refused(std::string("LUT_3D_SIZE 2\n\0", 15)), "a.cube is no text");
}

TEST(CubeFile, RefusesSizesWithoutTakingTheirMemory) {
  for (const std::string size : {"1", "257", "-3", "0", "99999999999", "3.5", "", "0x10"})
    EXPECT_NE(refused("LUT_3D_SIZE " + size + "\n").find("must be a whole number of 2 to 256"),
              std::string::npos)
        << size;
  EXPECT_EQ(refused("LUT_3D_SIZE 256\n0 0 0\n"),
            "a.cube is cut off: 6 bytes cannot hold the 16777216 nodes of LUT_3D_SIZE 256");
  EXPECT_EQ(refused("LUT_1D_SIZE 65536\n0 0 0\n"),
            "a.cube is cut off: 6 bytes cannot hold the 65536 nodes of LUT_1D_SIZE 65536");
  EXPECT_NE(refused("LUT_1D_SIZE 65537\n").find("must be a whole number of 2 to 65536"), std::string::npos);
}

TEST(CubeFile, ReadsNumbersAsTheyStandAndRefusesTheRest) {
  const auto first = [](const std::string& word) {
    return parse_cube("LUT_3D_SIZE 2\n" + word + " 0 0\n" + kNodes.substr(6), "a.cube").node(0, 0, 0).r;
  };
  EXPECT_EQ(first("1e-400"), 0) << "too small for 64 bits as well";
  EXPECT_EQ(first("-1e-60"), 0);
  EXPECT_EQ(first("+0.5"), 0.5f);
  EXPECT_EQ(first(".5"), 0.5f);
  const auto refusal = [](const std::string& word) {
    return refused("LUT_3D_SIZE 2\n0 " + word + " 0\n" + kNodes.substr(6));
  };
  for (const std::string word : {"+-0.5", "++1", "-+1", "+", "-", "1,5", "1e", "0.5f"})
    EXPECT_EQ(refusal(word), "a.cube, line 2: '" + word + "' is no number");
  EXPECT_EQ(refusal("3e38"), "a.cube, line 2: '3e38' does not lie within ±1e+30");
  EXPECT_EQ(refusal("-1e400"), "a.cube, line 2: '-1e400' does not lie within ±1e+30");
  EXPECT_EQ(refused("LUT_3D_SIZE 2\n" + kNodes.substr(0, 42) + "nan 1 1\n"),
            "a.cube, line 7: 'nan' is not finite");
  EXPECT_EQ(refused("INFO x\n"), "a.cube, line 1: 'INFO' is no keyword of a .cube file that is understood");
}

TEST(CubeFile, ReadsCurvesAsTheSpecificationPrintsThem) {
  // Adobe, Cube LUT Specification 1.0, example of a 1D table: the colours swap, as channels have curves each.
  const std::string text =
      "#Created by: Adobe Photoshop CS6\nTITLE \"demo\"\nLUT_1D_SIZE 3\nDOMAIN_MIN 0.0 0.0 0.0\n"
      "DOMAIN_MAX 255.0 255.0 255.0\n0.0 0.0 1\n0.5 0.75 0.5\n1 1 0\n";
  const CubeContent content = parse_cube_content(text, "a.cube");
  ASSERT_TRUE(content.curves.has_value());
  EXPECT_FALSE(content.lattice.has_value());
  EXPECT_EQ(content.curves->nodes.size(), 3u);
  const Lut lut = parse_cube(text, "a.cube");
  EXPECT_EQ(lut.size, 3);
  EXPECT_EQ(lut.title, "demo");
  EXPECT_EQ(lut.domain_max, (Rgb{255, 255, 255}));
  const Rgb out = sample_lut(lut, {63.75f, 191.25f, 127.5f}, LutInterpolation::kTetrahedral);
  EXPECT_FLOAT_EQ(out.r, 0.25f);
  EXPECT_FLOAT_EQ(out.g, 0.875f);
  EXPECT_FLOAT_EQ(out.b, 0.5f);
}

TEST(CubeFile, ShortCurvesAreKeptExactlyAndLongOnesNearly) {
  const auto curves_text = [](int size) {
    std::string text = "LUT_1D_SIZE " + std::to_string(size) + "\n";
    for (int i = 0; i < size; ++i) {
      const float x = static_cast<float>(i) / static_cast<float>(size - 1);
      text += std::to_string(x * x) + " " + std::to_string(std::sqrt(x)) + " " + std::to_string(1 - x) + "\n";
    }
    return text;
  };
  for (const int size : {2, 17, 65, 1024}) {
    const CubeContent content = parse_cube_content(curves_text(size), "a.cube");
    const Lut lut = lut_of_content(content);
    EXPECT_EQ(lut.size, std::min(size, kCurveLatticeSize));
    for (std::uint64_t i = 0; i < 200; ++i) {
      RandomStream random(8, 1, i);
      const Rgb c{random.next_float(), random.next_float(), random.next_float()};
      const Rgb exact = (*content.curves)(c), got = sample_lut(lut, c, LutInterpolation::kTrilinear);
      const double slack = size <= kCurveLatticeSize ? 1e-6 : 3e-4;
      EXPECT_NEAR(got.r, exact.r, slack);
      if (size <= kCurveLatticeSize || c.g > 0.1f) {
        EXPECT_NEAR(got.g, exact.g, slack);
      }
      EXPECT_NEAR(got.b, exact.b, slack);
    }
  }
  EXPECT_EQ(lut_of_content(parse_cube_content(curves_text(1024), "a.cube"), 20).size, 20);
}

TEST(CubeFile, AShaperBendsWhatEntersItsLattice) {
  // As DaVinci Resolve writes: the nodes of the curves, then those of the lattice.
  const std::string head = "LUT_1D_SIZE 3\nLUT_1D_INPUT_RANGE 0 4\nLUT_3D_SIZE 2\nLUT_3D_INPUT_RANGE 0 1\n",
                    shaper = "0 0 0\n0.75 0.75 0.75\n1 1 1\n";
  const Lut lut = parse_cube(head + shaper + kNodes, "a.cube");
  EXPECT_EQ(lut.size, kCurveLatticeSize);
  EXPECT_EQ(lut.domain_max, (Rgb{4, 4, 4}));
  // Red 1 is 0.375 behind the shaper; the lattice's red is its input, its green ¾ g + ¼ b there.
  const Rgb out = sample_lut(lut, {1, 0, 2}, LutInterpolation::kTetrahedral);
  EXPECT_NEAR(out.r, 0.375, 1e-6);
  EXPECT_NEAR(out.g, 0.25 * 0.75, 1e-6);
  EXPECT_NEAR(out.b, 0.75, 1e-6);
  EXPECT_EQ(refused(head + shaper), "a.cube is cut off: it holds 0 of the 8 nodes of LUT_3D_SIZE 2");
  EXPECT_EQ(refused(head + shaper + kNodes + "0 0 0\n"),
            "a.cube, line 16: there are more than the 8 nodes of LUT_3D_SIZE 2");
  EXPECT_EQ(refused("LUT_1D_SIZE 2\nLUT_1D_SIZE 2\n0 0 0\n1 1 1\n"),
            "a.cube, line 2: LUT_1D_SIZE stands there twice");
}

TEST(CubeFile, StripsAllowForRoundingAndNameWhatTheyCannotHold) {
  Lut lut = identity_lut(2);
  lut.node(0, 0, 0).r = -1e-6f;
  lut.node(1, 1, 1).b = 1.00009f;
  const DisplayImage strip = strip_of_lut(lut);
  EXPECT_EQ(strip.at(0, 0).r, 0);
  EXPECT_EQ(strip.at(3, 1).b, 1);
  lut.node(1, 0, 0).g = -0.001f;
  EXPECT_NE(message_of([&] { strip_of_lut(lut); }).find("node (1, 0, 0)"), std::string::npos);
}

TEST(CubeFile, StripsHoldRedAcrossGreenDownBlueFromTileToTile) {
  const Lut lut = bake_lut(4, [](Rgb c) { return Rgb{c.r, c.g * c.g, 1 - c.b}; });
  const DisplayImage strip = strip_of_lut(lut);
  EXPECT_EQ(strip.width(), 16);
  EXPECT_EQ(strip.height(), 4);
  EXPECT_EQ(strip.at(3, 0), lut.node(3, 0, 0));
  EXPECT_EQ(strip.at(0, 3), lut.node(0, 3, 0));
  EXPECT_EQ(strip.at(8, 0), lut.node(0, 0, 2));
  EXPECT_EQ(lut_of_strip(strip, "a.png").nodes, lut.nodes);
  EXPECT_THROW(lut_of_strip(DisplayImage(15, 4), "a.png"), InputError);
  EXPECT_THROW(lut_of_strip(DisplayImage(1, 1), "a.png"), InputError);
  EXPECT_THROW(strip_of_lut(bake_lut(2, [](Rgb c) { return c * 1.01f; })), InputError);
}

TEST(CubeFile, FilesOfBothKindsComeBack) {
  const TemporaryFolder folder;
  const Lut lut = bake_lut(5, [](Rgb c) { return Rgb{c.b, c.g * 0.5f, c.r}; });
  write_lut(folder.path() / "t.cube", lut);
  write_lut(folder.path() / "t.png", lut);
  EXPECT_EQ(read_lut(folder.path() / "t.cube").nodes, lut.nodes);
  const Lut strip = read_lut(folder.path() / "t.png");
  for (std::size_t i = 0; i < lut.nodes.size(); ++i)
    EXPECT_NEAR(strip.nodes[i].g, lut.nodes[i].g, 0.51 / 65535);
  EXPECT_THROW(write_lut(folder.path() / "t.3dl", lut), InputError);
  EXPECT_THROW(read_lut(folder.path() / "t.3dl"), InputError);
  EXPECT_THROW(read_lut(folder.path() / "none.cube"), InputError);
}

}  // namespace
}  // namespace plenolab
