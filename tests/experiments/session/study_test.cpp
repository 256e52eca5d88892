#include "experiments/session/study.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/io/image_file.h"
#include "experiments/session/example_study.h"
#include "experiments/session/plan.h"
#include "experiments/session/study_files.h"
#include "tests/experiments/session/tiny_study.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {

std::string without(const std::string& key) {
  std::string text = format_study(example_study());
  const std::size_t at = text.find("\"" + key + "\"");
  EXPECT_NE(at, std::string::npos);
  text.replace(at, key.size() + 2, "\"" + key + "x\"");
  return text;
}

std::string replaced(const std::string& from, const std::string& to) {
  std::string text = format_study(example_study());
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

void expect_refused(const std::string& json, const std::string& mentions) {
  const std::string message = message_of([&] { parse_study(json, "study.json"); });
  EXPECT_NE(message.find(mentions), std::string::npos) << message;
  EXPECT_NE(message.find("study.json"), std::string::npos) << message;
}

TEST(Study, SurvivesBeingWrittenAndReadAgain) {
  const StudyDefinition study = example_study();
  EXPECT_TRUE(parse_study(format_study(study), "study.json") == study);
  EXPECT_EQ(study_hash(parse_study(format_study(study), "study.json")), study_hash(study));
}

TEST(Study, EveryMistakeIsToldInOneSentenceWithItsKey) {
  expect_refused("{", "not valid JSON");
  expect_refused("[]", "must hold one object");
  expect_refused(replaced("\"seed\": 1,", ""), "\"seed\" is missing");
  expect_refused(without("text_screen"), "\"text_screenx\" is not a key");
  expect_refused(replaced("\"blank_ms\": 250", "\"blank_ms\": 249"),
                 "\"blank_ms\" must lie in [250, 10000], not 249");
  expect_refused(replaced("\"mode\": \"pilot\"", "\"mode\": \"simulated\""),
                 "\"mode\" must be \"real\" or \"pilot\"");
  expect_refused(replaced("\"display\": \"light-field\"", "\"display\": \"hmd\""),
                 "must be \"light-field\" or");
  expect_refused(replaced("\"id\": \"few\"", "\"id\": \"many\""), "\"images[1].id\" \"many\" is used twice");
  expect_refused(replaced("\"id\": \"few\"", "\"id\": \"../few\""), "letters, digits");
  expect_refused(replaced("\"id\": \"few\"", "\"id\": \"fewer\""), "names \"few\", which is not there");
  expect_refused(replaced("images/many-test.png", "../secret.png"), "must be a .png in the study's folder");
  expect_refused(replaced("images/many-test.png", "/etc/x.png"), "must be a .png in the study's folder");
  expect_refused(replaced("\"zoom\": 8", "\"zoom\": 0"), "\"blocks[1].zoom\" must lie in [1, 64]");
  expect_refused(replaced("\"headset\",\n        \"monitor\"", "\"headset\",\n        \"headset\""), "twice");
  expect_refused(replaced("\"version\": 1", "\"version\": 2"), "knows no other");
  expect_refused(std::string(100'000, '['), "nested too deeply");
}

TEST(Study, IsMadeOfTheImageSetOfReproject) {
  const TemporaryFolder folder;
  const std::filesystem::path images = folder.path() / "set";
  float grey = 0;
  for (const char* name : {"a", "b"})
    for (const char* kind : {"vc", "ic"})
      for (const char* part : {"panel", "centre", "light-field"})
        write_display_image(images / fmt::format("{}-{}-{}.png", name, kind, part),
                            DisplayImage(1, 1, Rgb{grey += 0.05f, 0, 0}));
  const StudyDefinition study = study_of_images(images, folder.path() / "study");
  ASSERT_EQ(study.images.size(), 3u);
  EXPECT_EQ(study.images[0].light_field.test, "images/a-ic-panel.png");
  EXPECT_EQ(study.images[0].monitor.reference, "images/a-vc-centre.png");
  EXPECT_TRUE(study.images[2].catch_trial);
  EXPECT_EQ(study.images[2].light_field.test, "images/b-vc-panel.png") << "plainly another image";
  write_text_file(folder.path() / "study" / "study.json", format_study(study));
  EXPECT_EQ(format_study(read_study(folder.path() / "study")), format_study(study));
  const std::string message =
      message_of([&] { study_of_images(folder.path() / "study", folder.path() / "x"); });
  EXPECT_NE(message.find("neither pairs"), std::string::npos) << message;
}

TEST(Study, ATestImageEqualToItsReferenceMustBeMeant) {
  const TemporaryFolder folder;
  StudyDefinition study = write_tiny_study(folder.path());
  const auto read = [&] {
    write_text_file(folder.path() / "study.json", format_study(study));
    return message_of([&] { read_study(folder.path()); });
  };
  EXPECT_EQ(read(), "");
  std::filesystem::copy_file(folder.path() / "two-reference.png", folder.path() / "two-test.png",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_NE(read().find("image \"two\" has the same content in two-reference.png and two-test.png"),
            std::string::npos)
      << read();
  study.images[1].identical = true;
  EXPECT_EQ(read(), "");
  study.images[0].identical = true;
  EXPECT_NE(read().find("one-reference.png and one-test.png differ"), std::string::npos) << read();
}

TEST(Study, ImageSetsWithEqualImagesAreRefusedBeforeAnythingIsWritten) {
  const TemporaryFolder folder;
  for (const char* name : {"x-reference.png", "x-test.png"})
    write_display_image(folder.path() / "set" / name, DisplayImage(1, 1));
  const std::string message =
      message_of([&] { study_of_images(folder.path() / "set", folder.path() / "study"); });
  EXPECT_NE(message.find("have the same content"), std::string::npos) << message;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "study"));
}

TEST(Study, TheConsentOfTheExampleIsAPlaceholder) {
  EXPECT_TRUE(is_placeholder(example_study().consent));
  StudyDefinition study = example_study();
  study.consent.text = "What we agreed on.";
  EXPECT_TRUE(is_placeholder(study.consent)) << "the guardian's too";
  study.consent.guardian_text = "And for guardians.";
  EXPECT_FALSE(is_placeholder(study.consent));
  study.consent.text = "Placeholder for the text of the board";
  EXPECT_TRUE(is_placeholder(study.consent));
}

TEST(Plan, IsAPureFunctionOfStudyAndNumber) {
  const StudyDefinition study = example_study();
  for (const int number : {1, 2, 34, 100'000}) {
    const SessionPlan plan = plan_session(study, number);
    EXPECT_TRUE(plan.blocks == plan_session(study, number).blocks);
    for (const PlannedBlock& block : plan.blocks) {
      std::map<std::string, int> times;
      for (const PlannedTrial& trial : block.trials) ++times[trial.image];
      EXPECT_EQ(times.size(), study.block(block.block).images.size());
      for (const auto& entry : times) EXPECT_EQ(entry.second, 1) << entry.first;
    }
  }
}

TEST(Plan, OrdersOfBlocksTakeTurns) {
  const StudyDefinition study = example_study();
  EXPECT_EQ(plan_session(study, 1).order, "headset-first");
  EXPECT_EQ(plan_session(study, 2).order, "monitor-first");
  EXPECT_EQ(plan_session(study, 2).blocks.front().block, "monitor");
  EXPECT_EQ(plan_session(study, 3).order, "headset-first");
}

TEST(Plan, PlacesAndSidesAreEquallyLikely) {
  const StudyDefinition study = example_study();
  constexpr int kNumbers = 3000;
  std::map<std::string, int> first;
  int left = 0, trials = 0;
  for (int number = 1; number <= kNumbers; ++number)
    for (const PlannedBlock& block : plan_session(study, number).blocks) {
      ++first[block.trials.front().image];
      for (const PlannedTrial& trial : block.trials) ++trials, left += trial.test_first;
    }
  // 6 images, 6000 blocks: 1000 each with a standard deviation of 28.9; five of them leave no room for
  // chance.
  for (const auto& entry : first) EXPECT_NEAR(entry.second, 1000, 145) << entry.first;
  EXPECT_NEAR(left, trials / 2, 5 * std::sqrt(trials) / 2);
}

}  // namespace
}  // namespace plenolab
