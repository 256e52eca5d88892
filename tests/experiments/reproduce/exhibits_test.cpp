#include "experiments/reproduce/exhibits/exhibits.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "core/base/error.h"
#include "experiments/reproduce/reproduction.h"
#include "experiments/reproduce/run.h"
#include "tests/experiments/run_program.h"

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

/// The sentence that refuses an id.
std::string refusal_of(const std::string& id) {
  try {
    select_reproductions({id});
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(Exhibits, AnUnknownIdIsToldWhereToLookWithoutAllTheOthers) {
  EXPECT_NE(refusal_of("doronin-fig-33").find("did you mean 'doronin-fig-3'?"), std::string::npos);
  EXPECT_NE(refusal_of("zhao-fig-13").find("in 'zhao-fig-24'"), std::string::npos);
  EXPECT_NE(refusal_of("Hansen-Fig-E.1").find("in 'hansen-fig-5.1'"), std::string::npos);
  EXPECT_NE(refusal_of("altmeier-fig-9").find("photographs of hardware"), std::string::npos);
  EXPECT_NE(refusal_of("nothing").find("--list"), std::string::npos);
  for (const char* id : {"doronin-fig-33", "zhao-fig-13", "altmeier-fig-9", "nothing"})
    EXPECT_LT(refusal_of(id).size(), 200u) << refusal_of(id);
}

TEST(Exhibits, AreFoundByTheIdsThatTheirNamesSuggest) {
  EXPECT_STREQ(exhibit_called("hansen-table-5.1").exhibit->name, "Table 5.1");
  EXPECT_STREQ(exhibit_called("doronin-fig-1").exhibit->name, "Figure 1");
  EXPECT_EQ(exhibit_called("altmeier-fig-99").exhibit, nullptr);
}

TEST(Exhibits, TheListSaysWhatTheStatusesMeanInStraightColumns) {
  const auto run = run_program({"reproduce", "--list"});
  ASSERT_EQ(run.status, 0) << run.err;
  for (const ExhibitStatus status : {ExhibitStatus::kRecomputed, ExhibitStatus::kRerun,
                                     ExhibitStatus::kDiagram, ExhibitStatus::kNotReproducible})
    EXPECT_NE(run.out.find(meaning_of(status)), std::string::npos);
  const std::string zhao = run.out.substr(run.out.find("\nZhao 2019"));
  std::set<std::size_t> columns;
  for (std::size_t at = zhao.find("\n  "); at != std::string::npos; at = zhao.find("\n  ", at + 1)) {
    const std::string line = zhao.substr(at + 1, zhao.find('\n', at + 1) - at - 1);
    for (const char* status :
         {"  recomputed ", "  re-run on our stimuli ", "  diagram ", "  not reproducible "})
      if (line.find(status) != std::string::npos) columns.insert(line.find(status));
  }
  EXPECT_EQ(columns.size(), 1u);
}

TEST(Report, OnlyTheFirstItemHasItsTimeForItself) {
  const Laboratory laboratory({.effort = Effort::kTiny, .cache = {}, .seed = 1, .threads = 1, .on_view = {}});
  std::vector<FinishedReproduction> finished(2);
  for (FinishedReproduction& f : finished) f.item = &reproductions().front();
  const Report report = assemble_report(finished, laboratory, {});
  std::vector<std::string> texts;
  for (const ReportSection& section : report.sections)
    for (const ReportBlock& block : section.blocks)
      if (const auto* paragraph = std::get_if<Paragraph>(&block);
          paragraph && paragraph->text.starts_with("Run alone"))
        texts.push_back(paragraph->text);
  ASSERT_EQ(texts.size(), 2u);
  EXPECT_EQ(texts[0].find("earlier items"), std::string::npos) << texts[0];
  EXPECT_NE(texts[1].find("earlier items"), std::string::npos) << texts[1];
}

}  // namespace
}  // namespace plenolab
