#include "analysis/calibration/open_directions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plenolab {

namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// Parts below this share of the largest are rounding.
constexpr double kNamedPart = 1e-6;
/// In a direction that is only weak, parts below this share are not worth a word.
constexpr double kNamedWeakPart = 0.02;
constexpr double kLargestChange = 0.01;

/// Brings the columns of a basis into reduced echelon form, so that each direction moves as few parameters as
/// can be.
Matrix sparse_basis(Matrix basis) {
  const Eigen::Index columns = basis.cols();
  std::vector<bool> used(static_cast<std::size_t>(basis.rows()), false);
  for (Eigen::Index c = 0; c < columns; ++c) {
    Eigen::Index pivot = -1;
    for (Eigen::Index r = 0; r < basis.rows(); ++r)
      if (!used[static_cast<std::size_t>(r)] &&
          (pivot < 0 || std::abs(basis(r, c)) > std::abs(basis(pivot, c))))
        pivot = r;
    used[static_cast<std::size_t>(pivot)] = true;
    basis.col(c) /= basis(pivot, c);
    for (Eigen::Index other = 0; other < columns; ++other)
      if (other != c) basis.col(other) -= basis(pivot, other) * basis.col(c);
  }
  return basis;
}

/// All coordinates of a direction given in the fitted ones.
Vector spread_out(const Vector& direction, const std::vector<Eigen::Index>& fitted) {
  Vector all = Vector::Zero(kCalibrationParameters);
  all(fitted) = direction;
  return all;
}

/// Changes of the parameters themselves: f changes with d_l although its coordinate stays.
ParameterValues changes_of(const Vector& direction, const CalibrationCoordinates& coordinates,
                           const DisplayGeometry<CalibrationJet>& geometry,
                           const std::vector<Eigen::Index>& fitted, double smallest_part) {
  ParameterValues change{};
  double largest = 0;
  for (const Eigen::Index i : fitted) {
    const auto index = static_cast<std::size_t>(i);
    const CalibrationJet value = parameter_value(geometry, static_cast<CalibrationParameter>(index));
    const double unit = traits_of(index).positive ? value.a : coordinates.unit_of(index);
    change[index] = value.v.dot(direction) / unit;
    largest = std::max(largest, std::abs(change[index]));
  }
  for (std::size_t i = 0; i < change.size(); ++i)
    change[i] = std::abs(change[i]) < smallest_part * largest ? 0 : change[i] / largest * kLargestChange;
  const auto first = std::find_if(change.begin(), change.end(), [](double c) { return c != 0; });
  if (first != change.end() && *first < 0)
    for (double& c : change) c = -c;
  for (std::size_t i = 0; i < change.size(); ++i)
    if (!traits_of(i).positive) change[i] *= coordinates.unit_of(i);
  return change;
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return text;
}

std::vector<std::string> symbols_in(const ParameterValues& change) {
  std::vector<std::string> symbols;
  for (std::size_t i = 0; i < change.size(); ++i)
    if (change[i] != 0) symbols.emplace_back(traits_of(i).symbol);
  return symbols;
}

std::string changes_text(const ParameterValues& change) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < change.size(); ++i) {
    if (change[i] == 0) continue;
    const ParameterTraits& traits = traits_of(i);
    parts.push_back(traits.positive ? fmt::format("{} {:+.2g} %", traits.symbol, change[i] * 100)
                                    : fmt::format("{} {:+.2g} {}", traits.symbol, change[i], traits.unit));
  }
  return listed(parts);
}

/// The combinations of the moved parameters that are determined all the same.
std::string determined_text(const std::vector<CalibrationEstimate>& derived) {
  std::vector<std::string> symbols;
  for (const CalibrationEstimate& e : derived)
    if (e.determined()) symbols.push_back(e.symbol);
  if (symbols.empty()) return "";
  return fmt::format("; determined {} {}", symbols.size() == 1 ? "is only" : "are only", listed(symbols));
}

std::string sentence_of(const ParameterValues& change, bool exact, double sd,
                        const std::vector<CalibrationEstimate>& derived) {
  const std::vector<std::string> symbols = symbols_in(change);
  if (exact && symbols.size() == 1)
    return fmt::format("{} is seen by no record and has no anchor.", symbols.front());
  if (exact)
    return fmt::format("{} cannot be told apart: {} leave every prediction as it is{}.", listed(symbols),
                       changes_text(change), determined_text(derived));
  const std::string what = symbols.size() == 1
                               ? fmt::format("{} is hardly seen by the records", symbols.front())
                               : fmt::format("{} can hardly be told apart", listed(symbols));
  return fmt::format("{}: along {} the standard deviation is {:.3g} %{}.", what, changes_text(change),
                     sd * 100, determined_text(derived));
}

}  // namespace

std::vector<OpenDirection> open_directions(const CalibrationCoordinates& coordinates,
                                           const DisplayGeometry<CalibrationJet>& geometry,
                                           const std::vector<Eigen::Index>& fitted, const Vector& singular,
                                           const Matrix& right, int rank,
                                           const std::vector<CalibrationEstimate>& derived) {
  std::vector<OpenDirection> open;
  const auto add = [&](const Vector& direction, bool exact, double sd) {
    OpenDirection o;
    o.change = changes_of(spread_out(direction, fitted), coordinates, geometry, fitted,
                          exact ? kNamedPart : kNamedWeakPart);
    o.exact = exact;
    o.sentence = sentence_of(o.change, exact, sd, derived);
    open.push_back(std::move(o));
  };
  const Matrix exactly_open = sparse_basis(right.rightCols(right.cols() - rank));
  for (Eigen::Index c = 0; c < exactly_open.cols(); ++c) add(exactly_open.col(c), true, 0);
  for (Eigen::Index k = rank - 1; k >= 0 && singular(k) * kKnownWithin < 1; --k)
    add(right.col(k), false, 1 / singular(k));
  return open;
}

}  // namespace plenolab
