#include "experiments/metric_list.h"

#include <fmt/format.h>

#include <cmath>

#include "metrics/table.h"

namespace plenolab {

namespace {

const char* words_for(Better better) {
  switch (better) {
    case Better::kHigher:
      return "higher is better";
    case Better::kLower:
      return "lower is better";
    case Better::kNearerZero:
      return "nearer to 0 is better";
    case Better::kNeither:
      return "describes";
  }
  return "";
}

std::string takes(const Metric& metric) {
  std::string text;
  const auto add = [&](bool taken, const char* what) {
    if (taken) text += (text.empty() ? "" : "; ") + std::string(what);
  };
  add(static_cast<bool>(metric.compare_scene), "two images with radiance");
  add(static_cast<bool>(metric.compare_display), "two pictures");
  add(static_cast<bool>(metric.compare_mapped), "a tone mapped picture and its scene");
  add(static_cast<bool>(metric.judge), "a picture alone");
  if (metric.absolute_luminance) text += "; needs cd/m²";
  if (metric.viewing) text += "; depends on the viewer";
  return text;
}

/// "1" and the like say nothing.
std::string unit_text(const MetricQuantity& quantity) {
  return quantity.unit == "1" ? "" : fmt::format(" [{}]", quantity.unit);
}

}  // namespace

std::string metric_list_text() {
  std::string text;
  for (const Metric& metric : metrics()) {
    text +=
        fmt::format("{} ({}): {}\n  takes {}\n", metric.name, metric.family, metric.summary, takes(metric));
    for (const MetricQuantity& q : metric.quantities)
      text += fmt::format("  {:<42} {:<22} {}\n", q.name + unit_text(q), words_for(q.better), q.meaning);
    text += "\n";
  }
  return text;
}

ResultTable metric_list_rows() {
  ResultTable table;
  for (const Metric& metric : metrics())
    for (const MetricQuantity& q : metric.quantities)
      table.add({q.name,
                 q.minimum,
                 q.unit,
                 {{"metric", metric.name},
                  {"family", metric.family},
                  {"takes", takes(metric)},
                  {"better", std::string(words_for(q.better))},
                  {"of_equal_images", std::isnan(q.identical) ? std::string("depends on the image")
                                                              : fmt::format("{}", q.identical)},
                  {"meaning", q.meaning}}});
  return table;
}

}  // namespace plenolab
