#include "experiments/reproduce/exhibits/exhibits.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "experiments/reproduce/reproduction.h"

namespace plenolab {
namespace {

std::set<std::string> item_ids() {
  std::set<std::string> ids;
  for (const Reproduction& item : reproductions()) ids.insert(item.id);
  return ids;
}

TEST(Exhibits, WhatIsReproducedNamesAnItemAndWhatIsNotSaysWhy) {
  const std::set<std::string> ids = item_ids();
  for (const Paper& paper : papers())
    for (const Exhibit& e : paper.exhibits) {
      const std::string which = fmt::format("{} {}", paper.name, e.name);
      if (e.status == ExhibitStatus::kNotReproducible) {
        EXPECT_STREQ(e.item, "") << which;
        EXPECT_STRNE(e.note, "") << which;
      } else if (e.status == ExhibitStatus::kDiagram) {
        EXPECT_TRUE(*e.item == '\0' || ids.contains(e.item)) << which << " names " << e.item;
        EXPECT_STRNE(e.note, "") << which;
      } else {
        EXPECT_TRUE(ids.contains(e.item)) << which << " names " << e.item;
      }
    }
}

TEST(Exhibits, DrawingsAreCalledDiagramsAndNothingElse) {
  const std::map<std::string, std::set<std::string>> diagrams{
      {"Altmeier 2018", {"Figure 2", "Figure 12", "Figure 13", "Figure 14", "Figure 15", "Figure 20"}},
      {"Doronin & Barsi", {"Figure 1"}},
      {"Hansen & Klein 2016",
       {"Figure 3.1", "Figure 3.4", "Figure 3.5", "Figure 3.6", "Figure 3.9", "Figure C.1", "Figure C.2",
        "Figure G.1", "Figure G.2"}},
      {"Hansen, Klein & Kraus", {"Figure 1", "Figure 2", "Figure 3"}},
      {"Zhao 2019", {"Figure 8", "Figure 14", "Figure 18", "Figure 19", "Figure 20"}}};
  for (const Paper& paper : papers()) {
    std::set<std::string> called;
    for (const Exhibit& e : paper.exhibits) {
      if (e.status == ExhibitStatus::kDiagram) called.insert(e.name);
      EXPECT_EQ(std::string(e.note).find("diagram"), std::string::npos) << paper.name << " " << e.name;
    }
    EXPECT_EQ(called, diagrams.at(paper.name)) << paper.name;
  }
}

TEST(Exhibits, EveryItemOfAFigureOrTableIsNamedByAnExhibit) {
  std::set<std::string> named;
  for (const Paper& paper : papers())
    for (const Exhibit& e : paper.exhibits) named.insert(e.item);
  for (const std::string& id : item_ids()) {
    const bool printed = id.find("-fig-") != std::string::npos || id.find("-table-") != std::string::npos;
    const bool audit = id.find("-audit-") != std::string::npos;
    EXPECT_TRUE(!printed || audit || named.contains(id)) << id;
  }
}

/// Figures and tables that each paper has, counted in the papers.
TEST(Exhibits, NoneIsForgottenAndNoneNamedTwice) {
  const std::map<std::string, std::pair<int, int>> printed{{"Altmeier 2018", {47, 0}},
                                                           {"Doronin & Barsi", {6, 0}},
                                                           {"Hansen & Klein 2016", {32, 5}},
                                                           {"Hansen, Klein & Kraus", {6, 0}},
                                                           {"Zhao 2019", {26, 3}}};
  ASSERT_EQ(papers().size(), printed.size());
  for (const Paper& paper : papers()) {
    int figures = 0, tables = 0;
    std::set<std::string> names;
    for (const Exhibit& e : paper.exhibits) {
      ++(std::string(e.name).starts_with("Figure") ? figures : tables);
      EXPECT_TRUE(names.insert(e.name).second) << paper.name << " " << e.name;
    }
    EXPECT_EQ(std::pair(figures, tables), printed.at(paper.name)) << paper.name;
  }
}

}  // namespace
}  // namespace plenolab
