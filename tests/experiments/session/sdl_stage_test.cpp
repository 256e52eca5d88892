#include "experiments/session/sdl_stage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "core/base/file.h"
#include "core/io/image_file.h"
#include "experiments/session/runner.h"
#include "experiments/session/same_study.h"
#include "experiments/session/simulated_stage.h"
#include "experiments/session/virtual_pad.h"
#include "tests/experiments/session/tiny_study.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;

Picture image_picture(const fs::path& file, int zoom) {
  Picture picture{.kind = Picture::Kind::kImage, .file = file};
  picture.zoom = zoom;
  return picture;
}

// SDL's dummy display draws in memory: what a participant would see can be looked at pixel by pixel.
TEST(SdlStage, ShowsImagesMagnifiedPixelByPixelInTheMiddleOfBlack) {
  ::setenv("SDL_AUDIODRIVER", "dummy", 1);
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "image.png", shots = folder.path() / "shots";
  DisplayImage image(2, 3, Rgb{0, 0, 0});
  image.at(0, 0) = {1, 0, 0};
  image.at(1, 2) = {0, 51 / 255.0f, 1};
  write_display_image(file, image);
  const SdlLibrary sdl(SdlLibrary::Use::kHeadless);
  SdlStage stage({.screenshots = shots});
  const DisplayReport display = stage.open_display(0);
  EXPECT_GT(display.interval_ms, 0);
  EXPECT_FALSE(display.vsync) << "memory waits for no display, whatever SDL says of its renderer";
  stage.load({image_picture(file, 8)});
  stage.draw(image_picture(file, 8));
  const std::int64_t first_us = stage.flip();
  EXPECT_GT(stage.flip(), first_us);
  const DisplayImage seen = read_display_image(shots / "001.png");
  ASSERT_EQ(seen.width(), display.width_px);
  ASSERT_EQ(seen.height(), display.height_px);
  const int left = (display.width_px - 16) / 2, top = (display.height_px - 24) / 2;
  for (int y = 0; y < seen.height(); ++y)
    for (int x = 0; x < seen.width(); ++x) {
      const bool inside = x >= left && x < left + 16 && y >= top && y < top + 24;
      const Rgb expected = inside ? image.at((x - left) / 8, (y - top) / 8) : Rgb{0, 0, 0};
      ASSERT_EQ(seen.at(x, y), expected) << x << "," << y;
    }
}

TEST(SdlStage, RefusesDisplaysThatAreNotThereAndImagesThatDoNotFit) {
  ::setenv("SDL_AUDIODRIVER", "dummy", 1);
  const TemporaryFolder folder;
  write_display_image(folder.path() / "wide.png", DisplayImage(200, 1));
  const SdlLibrary sdl(SdlLibrary::Use::kHeadless);
  SdlStage stage({});
  EXPECT_NE(message_of([&] { stage.open_display(7); }).find("wants display 7, but there are only 1"),
            std::string::npos);
  stage.open_display(0);
  const std::string message =
      message_of([&] { stage.load({image_picture(folder.path() / "wide.png", 64)}); });
  EXPECT_NE(message.find("12800×64 px at zoom 64, larger than the display"), std::string::npos) << message;
  EXPECT_EQ(stage.equipment().pad, "");
}

TEST(SdlStage, InputsCarryATimeAtWhichTheyHadHappened) {
  ::setenv("SDL_AUDIODRIVER", "dummy", 1);
  const SdlLibrary sdl(SdlLibrary::Use::kHeadless);
  SdlStage stage({});
  stage.open_display(0);
  VirtualPad pad;
  pad.plug();
  stage.poll();
  pad.button("a", true);
  const std::int64_t before_us = stage.flip();  // may poll
  stage.poll();
  pad.button("b", true);
  // SDL hands the input on only after 30 ms of collecting.
  SDL_SetEventFilter([](void*, SDL_Event*) { return SDL_Delay(30), 1; }, nullptr);
  const auto inputs = stage.poll();
  SDL_SetEventFilter(nullptr, nullptr);
  ASSERT_FALSE(inputs.empty());
  EXPECT_EQ(inputs.back().name, "b");
  EXPECT_GE(inputs.back().t_us - inputs.back().t_low_us, 30'000);
  EXPECT_GE(inputs.back().t_low_us, before_us);
}

// SDL's disk driver writes what would be heard into a file.
TEST(SdlStage, TonesAreHeard) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "heard.raw";
  ::setenv("SDL_AUDIODRIVER", "disk", 1), ::setenv("SDL_DISKAUDIOFILE", file.c_str(), 1);
  {
    const SdlLibrary sdl(SdlLibrary::Use::kHeadless);
    SdlStage stage({});
    ASSERT_TRUE(stage.equipment().audio) << SDL_GetError();
    SDL_Delay(50);
    EXPECT_TRUE(stage.tone());
    SDL_Delay(400);
  }
  ::setenv("SDL_AUDIODRIVER", "dummy", 1), ::unsetenv("SDL_DISKAUDIOFILE");
  const std::string bytes = read_text_file(file);
  std::vector<std::int16_t> heard(bytes.size() / 2);
  std::memcpy(heard.data(), bytes.data(), heard.size() * 2);
  const auto loud =
      std::count_if(heard.begin(), heard.end(), [](std::int16_t s) { return std::abs(s) > 4000; });
  EXPECT_NEAR(static_cast<double>(loud), 0.15 * 44100 * 2 / 3, 400)
      << "two thirds of a sine exceed half its height";
  EXPECT_EQ(heard.front(), 0);
  EXPECT_EQ(heard.back(), 0);
}

TEST(SdlStage, ASpareControllerTakesOverWhenTheOneInUseIsUnplugged) {
  const SdlLibrary sdl(SdlLibrary::Use::kHeadless);
  SdlInput input;
  VirtualPad first, spare;
  first.plug();
  input.poll(0, 1);
  spare.plug();
  spare.button("a", true);
  EXPECT_TRUE(input.poll(1, 2).empty()) << "the spare is left alone";
  spare.button("a", false);
  first.unplug();
  const auto inputs = input.poll(2, 3);
  ASSERT_GE(inputs.size(), 2u);
  EXPECT_EQ(inputs[0].kind, RawInput::Kind::kDisconnected);
  EXPECT_EQ(inputs[1].kind, RawInput::Kind::kConnected);
  spare.button("b", true);
  const auto pressed = input.poll(3, 4);
  ASSERT_EQ(pressed.size(), 1u);
  EXPECT_EQ(pressed[0].name, "b");
  EXPECT_TRUE(input.rumble(10));
  EXPECT_EQ(spare.rumbles(), 1);
}

TEST(SdlStage, OnlyASwapIntervalOfOneWaitsForTheDisplay) {
  EXPECT_TRUE(waits_for_display("opengl", 1));
  EXPECT_TRUE(waits_for_display("opengles2", 1));
  EXPECT_FALSE(waits_for_display("opengl", 0));
  EXPECT_FALSE(waits_for_display("opengl", -1)) << "late frames tear";
  EXPECT_FALSE(waits_for_display("software", 1));
}

TEST(SdlStage, BeingToldToStopCountsAsClosingTheWindow) {
  ::setenv("SDL_AUDIODRIVER", "dummy", 1);
  const SdlLibrary sdl(SdlLibrary::Use::kHeadless);
  bool stop = false;
  SdlStage stage({.stop_requested = [&] { return stop; }});
  EXPECT_TRUE(stage.poll().empty());
  stop = true;
  const auto inputs = stage.poll();
  ASSERT_EQ(inputs.size(), 1u);
  EXPECT_EQ(inputs[0].kind, RawInput::Kind::kClose);
}

TEST(SdlStage, PagesAreReadableTextInsideTheDisplay) {
  ::setenv("SDL_AUDIODRIVER", "dummy", 1);
  const TemporaryFolder folder;
  const SdlLibrary sdl(SdlLibrary::Use::kHeadless);
  SdlStage stage({.screenshots = folder.path()});
  const DisplayReport display = stage.open_display(0);
  Picture page{.kind = Picture::Kind::kPage};
  page.page = {"How hard was it? äöü €", {"easy", "hard"}, 1, "Return: go on"};
  stage.draw(page);
  const DisplayImage seen = read_display_image(folder.path() / "001.png");
  int lit = 0, at_edge = 0;
  for (int y = 0; y < seen.height(); ++y)
    for (int x = 0; x < seen.width(); ++x) {
      const bool ink = seen.at(x, y).r > 0.5f;
      lit += ink;
      at_edge += ink && (x < display.width_px / 20 || x >= display.width_px * 19 / 20);
    }
  EXPECT_GT(lit, 500);
  EXPECT_EQ(at_edge, 0);
}

TEST(SimulatedStage, ChoicesThatAreRefusedVibrateThePad) {
  const TemporaryFolder folder;
  const StudyDefinition study = write_tiny_study(folder.path() / "study");
  SessionStore store = SessionStore::create(
      folder.path() / "sessions", new_identity(study, SessionMode::kSimulated, 1), Durability::kProcessEnd);
  const SdlLibrary sdl(SdlLibrary::Use::kHeadless);
  SimulatedStage stage({.kind = ObserverKind::kImpatient, .rate = 1});
  EXPECT_EQ(run_session(store, stage, {.images = folder.path() / "study"}), SessionState::kDone);
  EXPECT_EQ(stage.tones(), 12) << "six times the same image, six times the reference chosen";
  EXPECT_GE(stage.rumbles(), 1) << "SDL lengthens a vibration that is still going on";
}

}  // namespace
}  // namespace plenolab
