#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/tonemap/light_field_mapping.h"
#include "experiments/cli/operator_options.h"
#include "experiments/reproduce/reproduction.h"

namespace plenolab {

/// How operators suit scenes (thesis of Altmeier, section 6.3): key views tone mapped, and how much contrast
/// and luma parts of them are left with. Nothing is synthesised.

/// An operator and what to call it.
struct SectionOperator {
  std::string label;
  OperatorChoice choice;
};

/// The three operators of the section as it uses them (histogram adjustment of each view, enhanced bilateral,
/// naive Reinhard 2005) and the robust one beside them, all at default settings.
std::vector<SectionOperator> section_operators();
/// One of the table of operators (choose_operator).
SectionOperator section_operator(const std::string& label, const std::string& id, const std::string& variant,
                                 const std::vector<std::string>& settings = {});

/// A key view and what its parts are told by.
struct SectionView {
  std::string name;  ///< "column, row"
  OperatorView data;
  Plane<float> log_luminance;      ///< log10, floored with the log floor of the light field
  double log_p1 = 0, log_p99 = 0;  ///< percentiles of log_luminance
  Plane<float> depth_m;            ///< planar, infinite where disparity is 0
  Plane<float> height_m;  ///< of what is seen, above the scene's floor; that of the camera at infinity

  double log_range() const { return log_p99 - log_p1; }
};

/// The key views of a scene and their tone mapping. Fits of one choice to the light field are made once.
class SectionScene {
 public:
  SectionScene(Laboratory& laboratory, std::string id);

  const std::string& id() const { return id_; }
  const std::string& title() const { return title_; }
  const ViewGrid& grid() const { return field_.grid(); }
  const LightField& field() const { return field_; }
  const LightFieldStatistics& statistics() const { return statistics_; }
  int views() const { return grid().columns * grid().rows; }
  int middle() const { return grid().rows / 2 * grid().columns + grid().columns / 2; }
  /// The views of the middle row.
  std::vector<int> middle_row() const;

  /// View `index`, row by row.
  SectionView view(int index) const;
  /// The fit to all key views of a variant for light fields.
  const FittedOperator& joint_fit(const SectionOperator& chosen);
  /// That view tone mapped with a variant for views or for light fields.
  DisplayImage map(const SectionOperator& chosen, int index);

 private:
  std::string id_, title_;
  GridCamera camera_;
  LightField field_;
  int threads_;
  LightFieldStatistics statistics_;
  std::map<std::string, FittedOperator> joint_fits_;  ///< by operator, variant and settings
};

Plane<float> luma_plane(const DisplayImage& image);

/// All pixels of a view.
Mask whole(const Plane<float>& like);
/// Pixels deeper than `depth_m`: what lies outside of a room of that length.
Mask deeper_than(const SectionView& view, double depth_m);
/// Pixels that show heights in [low, high] and nothing farther than `depth_m`.
Mask at_heights(const SectionView& view, double low_m, double high_m, double depth_m);
/// Those of a mask with a log luminance below its quantile p.
Mask darker_part(const SectionView& view, const Mask& mask, double p);
Mask without(const Mask& mask, const Mask& removed);
Mask both(const Mask& a, const Mask& b);

/// Quantiles p, 0.5 and 1 − p of values; zeros for no values.
struct ToneSpread {
  double low = 0, middle = 0, high = 0;
  double range() const { return high - low; }
};
/// Of the values where the mask is set.
ToneSpread spread_in(const Plane<float>& values, const Mask& mask, double p);

/// Pixels of a view and what the scene is there.
struct ToneRegion {
  Mask mask;
  double tail = 0.1;  ///< p of the spreads
  ToneSpread log_luminance;
};
ToneRegion region_of(const SectionView& view, Mask mask, double tail);

/// Contrast of luma for a contrast of log luminance, relative to a straight line in log luminance that takes
/// the first to the 99th percentile of the view to luma 0 … 1: 1 keeps the proportion of the view's
/// contrasts, 0 keeps nothing. 0 where the scene has no contrast.
double relative_contrast(double luma, double log_luminance, const SectionView& view);

/// Contrast of luma between the ends of its spread in a region, relative to that of the scene there.
double contrast_within(const SectionView& view, const ToneRegion& region, const ToneSpread& luma);

/// A colour for the pixels of a mask.
struct RegionMark {
  const Mask& mask;
  Rgb colour;
};
/// The display image, dimmed and grey but where masks colour it.
DisplayImage region_map(const DisplayImage& image, const std::vector<RegionMark>& marks);

}  // namespace plenolab
