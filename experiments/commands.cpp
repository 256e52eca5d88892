#include "experiments/commands.h"

#include <array>

namespace plenolab {

void add_scenes_command(CLI::App& app, const Invocation& invocation);
void add_render_command(CLI::App& app, const Invocation& invocation);
void add_info_command(CLI::App& app, const Invocation& invocation);
void add_convert_command(CLI::App& app, const Invocation& invocation);
void add_synth_command(CLI::App& app, const Invocation& invocation);
void add_video_command(CLI::App& app, const Invocation& invocation);
void add_tonemap_command(CLI::App& app, const Invocation& invocation);
void add_tonemap_lf_command(CLI::App& app, const Invocation& invocation);
void add_adjust_lf_command(CLI::App& app, const Invocation& invocation);
void add_epi_command(CLI::App& app, const Invocation& invocation);
void add_metric_command(CLI::App& app, const Invocation& invocation);
void add_train_brisque_command(CLI::App& app, const Invocation& invocation);
void add_batch_command(CLI::App& app, const Invocation& invocation);
void add_evaluate_command(CLI::App& app, const Invocation& invocation);
void add_reproject_command(CLI::App& app, const Invocation& invocation);
void add_optimise_command(CLI::App& app, const Invocation& invocation);
void add_lut_command(CLI::App& app, const Invocation& invocation);
void add_luminance_command(CLI::App& app, const Invocation& invocation);
void add_sweep_command(CLI::App& app, const Invocation& invocation);
void add_session_command(CLI::App& app, const Invocation& invocation);
void add_analyse_command(CLI::App& app, const Invocation& invocation);
void add_calibrate_command(CLI::App& app, const Invocation& invocation);
void add_reproduce_command(CLI::App& app, const Invocation& invocation);

std::span<const Command> commands() {
  static constexpr std::array kCommands{
      Command{"scenes", "List the scenes there are to render", add_scenes_command},
      Command{"render", "Render a scene as a light field, or one view of it", add_render_command},
      Command{"info", "Profile and photometric self-check of a light field; statistics of an image",
              add_info_command},
      Command{"convert", "Convert HCI folders, bare EXR folders and light fields into each other",
              add_convert_command},
      Command{"synth", "Synthesise one novel view", add_synth_command},
      Command{"video", "Synthesise the frames of a camera path", add_video_command},
      Command{"tonemap", "Tone map one image, or list the operators there are", add_tonemap_command},
      Command{"tonemap-lf", "Tone map all views of a light field with one rule", add_tonemap_lf_command},
      Command{"adjust-lf", "Key-view adjustment: draw corresponding pixels of tone mapped key views together",
              add_adjust_lf_command},
      Command{"epi", "Cut an epipolar-plane image out of a sequence of frames", add_epi_command},
      Command{"metric", "Compare a test image with a reference", add_metric_command},
      Command{"train-brisque", "Train the no-reference metric on distorted pictures of the scenes",
              add_train_brisque_command},
      Command{"batch", "Scenes and light fields by operators by metrics: resumable, in parts, one report",
              add_batch_command},
      Command{"evaluate", "What would a sparser capture cost: synthesise the views in between and score them",
              add_evaluate_command},
      Command{"reproject", "Light-field image for the near-eye display from four or five rendered cameras",
              add_reproject_command},
      Command{"optimise", "Tune the generic operator to one image by a quality metric", add_optimise_command},
      Command{"lut", "Look-up tables of colour: apply, blend, transfer, post-processing volumes",
              add_lut_command},
      Command{"luminance",
              "Luminance that observers of a light-field display adapt to, and tone mapping with it",
              add_luminance_command},
      Command{"sweep", "Error against run time and memory of a method", add_sweep_command},
      Command{"session", "Participant sessions: run, resume, simulate, list and export them",
              add_session_command},
      Command{"analyse", "Statistics of sessions: tests, tables, fits, planning", add_analyse_command},
      Command{"calibrate", "Fit lengths and angles of a near-eye display to measurement records",
              add_calibrate_command},
      Command{"reproduce", "Reproduce figures, tables and claims of the papers in a report",
              add_reproduce_command},
  };
  return kCommands;
}

}  // namespace plenolab
