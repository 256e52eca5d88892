#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "core/base/file.h"
#include "experiments/brisque_training.h"
#include "experiments/cli/checks.h"
#include "experiments/cli/output.h"
#include "experiments/cli/progress_bar.h"
#include "experiments/commands.h"

namespace plenolab {

namespace {

struct TrainOptions {
  CommonOptions common;
  std::string out, cache;
  BrisqueTrainingOptions training;
};

void add_agreement_rows(ResultTable& table, const std::string& pictures, const Agreement& agreement) {
  const std::vector<std::pair<std::string, Cell>> columns{{"pictures", pictures}};
  table.add({"count", static_cast<double>(agreement.pictures), "pictures", columns});
  if (pictures != "none") {  // all targets are 0: nothing to correlate with
    table.add({"hold_out_pearson", agreement.pearson, "1", columns});
    table.add({"hold_out_spearman", agreement.spearman, "1", columns});
  }
  table.add({"hold_out_rms_error", agreement.rms_error, "1", columns});
}

/// Agreement of those pictures for which `wanted` is true.
template <class Wanted>
Agreement agreement_where(const std::vector<TrainingPicture>& pictures, const std::vector<double>& scores,
                          Wanted wanted) {
  std::vector<double> some_scores, targets;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (!wanted(pictures[i])) continue;
    some_scores.push_back(scores[i]);
    targets.push_back(pictures[i].target);
  }
  return agreement(some_scores, targets);
}

/// How held-out scores agree with targets: over all pictures, by distortion and by scene.
ResultTable hold_out_table(const std::vector<TrainingPicture>& pictures, const std::vector<double>& scores) {
  ResultTable table;
  add_agreement_rows(table, "all", agreement_where(pictures, scores, [](const auto&) { return true; }));
  std::vector<std::string> distortions, scene_ids;
  const auto note = [](std::vector<std::string>& names, const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const TrainingPicture& picture : pictures) {
    note(distortions, picture.distortion);
    note(scene_ids, picture.scene);
  }
  for (const std::string& name : distortions)
    add_agreement_rows(
        table, name, agreement_where(pictures, scores, [&](const auto& p) { return p.distortion == name; }));
  for (const std::string& id : scene_ids)
    add_agreement_rows(table, id,
                       agreement_where(pictures, scores, [&](const auto& p) { return p.scene == id; }));
  return table;
}

std::vector<std::string> provenance_lines(const BrisqueTrainingOptions& training, const Agreement& all) {
  return {
      fmt::format("Written by plenolab train-brisque --seed {} --paths {} --width {} --ridge {}: ridge",
                  training.seed, training.paths_per_pixel, training.width, training.ridge),
      fmt::format(
          "regression on {} pictures of plenolab's scenes with targets 100·(1 − SSIM). For scenes that",
          all.pictures),
      fmt::format("were left out of the training, scores and targets correlate with r = {:.3f} (Pearson) and",
                  all.pearson),
      fmt::format("{:.3f} (Spearman), with an RMS error of {:.1f}.", all.spearman, all.rms_error)};
}

void run_train(const Invocation& invocation, TrainOptions options) {
  Provenance provenance = begin_run(invocation, options.common);
  BrisqueTrainingOptions& training = options.training;
  training.cache = render_cache_folder(options.cache);
  training.seed = options.common.seed;
  training.threads = options.common.threads;
  provenance.parameters["paths_per_pixel"] = training.paths_per_pixel;
  provenance.parameters["width"] = training.width;
  provenance.parameters["ridge"] = training.ridge;
  ProgressBar bar("train");
  const std::vector<TrainingPicture> pictures = brisque_training_pictures(training, bar.callback());
  bar.clear();
  const std::vector<double> scores = hold_out_scores(pictures, training.ridge);
  if (!options.out.empty()) {
    const Agreement all = agreement_where(pictures, scores, [](const auto&) { return true; });
    write_text_file(options.out, brisque_weights_header(train_brisque(pictures, training.ridge),
                                                        provenance_lines(training, all)));
    write_run_json_beside(options.out, provenance);
    tell(options.common, fmt::format("wrote {}", options.out));
  }
  emit_results(hold_out_table(pictures, scores), provenance, options.common);
}

}  // namespace

void add_train_brisque_command(CLI::App& app, const Invocation& invocation) {
  auto options = std::make_shared<TrainOptions>();
  app.add_option("-o,--out", options->out, "Header for the weights: metrics/brisque_weights.h of the sources")
      ->check(file_ending_in({".h"}));
  app.add_option("--paths", options->training.paths_per_pixel,
                 "Paths per pixel of the views, a multiple of 16")
      ->check(multiple_of(16, 65536))
      ->capture_default_str();
  app.add_option("--width", options->training.width,
                 "Width of the rendered views, px; pictures have half of it")
      ->check(whole_number(64, 4096))
      ->capture_default_str();
  app.add_option("--ridge", options->training.ridge,
                 "Penalty on squared weights, in thousandths of a picture each")
      ->check(positive_number())
      ->capture_default_str();
  app.add_option("--cache", options->cache, "Folder of rendered views");
  add_common_options(app, options->common);
  app.footer("Example: plenolab train-brisque --json hold-out.json");
  app.callback([options, &invocation] { run_train(invocation, *options); });
}

}  // namespace plenolab
