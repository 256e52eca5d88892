#include "tests/experiments/session/tiny_study.h"

#include "core/base/file.h"
#include "core/io/image_file.h"

namespace plenolab {

StudyDefinition write_tiny_study(const std::filesystem::path& folder, SessionMode mode) {
  StudyDefinition study;
  study.title = "Tiny";
  study.mode = mode;
  study.consent = {"Do you agree?", "Does your guardian agree?", 18, false};
  for (const char* id : {"one", "two", "odd"}) {
    const StimulusFiles files{std::string(id) + "-reference.png", std::string(id) + "-test.png"};
    study.images.push_back({id, std::string(id) == "odd", files, files});
    write_display_image(folder / files.reference, DisplayImage(2, 2, Rgb{0.2f, 0.4f, 0.6f}));
    write_display_image(folder / files.test, DisplayImage(2, 2, Rgb{0.6f, 0.4f, 0.2f}));
  }
  study.blocks = {{"headset", DisplayKind::kLightField, 0, 1, {"one", "two", "odd"}},
                  {"monitor", DisplayKind::kMonitor, 0, 8, {"one", "two", "odd"}}};
  study.orders = {{"headset-first", {"headset", "monitor"}}, {"monitor-first", {"monitor", "headset"}}};
  study.questionnaire = {{"hard", "How hard was it?", {"easy", "hard"}}};
  write_text_file(folder / "study.json", format_study(study));
  return study;
}

}  // namespace plenolab
