#include "analysis/provenance.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <regex>

#include "core/base/content_hash.h"
#include "core/base/error.h"
#include "core/base/file.h"

namespace plenolab {
namespace {

TEST(Provenance, RecordsTimeBuildMachineAndLibraries) {
  const char* arguments[] = {"plenolab", "synth", "--at", "1,2"};
  Provenance provenance = start_provenance(4, arguments);
  finish_provenance(provenance);
  const auto json = provenance_to_json(provenance);
  EXPECT_EQ(json["command_line"].size(), 4u);
  EXPECT_TRUE(std::regex_match(json["started_utc"].get<std::string>(),
                               std::regex(R"(20\d\d-[01]\d-[0-3]\dT[0-2]\d:[0-5]\d:[0-6]\dZ)")));
  EXPECT_GE(json["duration_s"].get<double>(), 0);
  EXPECT_GT(json["peak_memory_mib"].get<double>(), 1);
  EXPECT_GE(json["machine"]["cores"].get<int>(), 1);
  EXPECT_GT(json["machine"]["memory_gib"].get<double>(), 0.1);
  EXPECT_FALSE(json["machine"]["os"].get<std::string>().empty());
  EXPECT_FALSE(json["build"]["revision"].get<std::string>().empty());
  EXPECT_TRUE(json["build"]["dirty"].is_boolean());
  EXPECT_NE(json["build"]["flags"].get<std::string>().find("-ffp-contract=off"), std::string::npos);
  EXPECT_TRUE(json["libraries"].contains("OpenEXR"));
  EXPECT_TRUE(json["seed"].is_null());
}

TEST(Provenance, HashesInputFilesAndFolders) {
  const TemporaryFolder folder;
  write_text_file(folder.path() / "a.txt", "alpha");
  write_text_file(folder.path() / "b.txt", "beta");
  Provenance provenance = start_provenance({"plenolab"});
  add_input(provenance, folder.path() / "a.txt");
  add_input(provenance, folder.path());
  EXPECT_EQ(provenance.inputs[0].hash, hash_file(folder.path() / "a.txt"));
  write_text_file(folder.path() / "b.txt", "gamma");
  add_input(provenance, folder.path());
  EXPECT_NE(provenance.inputs[1].hash, provenance.inputs[2].hash);
  EXPECT_THROW(add_input(provenance, folder.path() / "missing"), InputError);
}

TEST(Provenance, WritesValidJsonEvenForArgumentsThatAreNotUtf8) {
  const TemporaryFolder folder;
  Provenance provenance = start_provenance({"plenolab", "caf\xe9.exr"});
  provenance.seed = 18446744073709551615ull;
  provenance.parameters["step"] = 0.5;
  write_run_json(provenance, folder.path() / "new");
  const auto json = nlohmann::json::parse(read_text_file(folder.path() / "new" / "run.json"));
  EXPECT_EQ(json["seed"].get<std::uint64_t>(), 18446744073709551615ull);
  EXPECT_EQ(json["parameters"]["step"], 0.5);
}

}  // namespace
}  // namespace plenolab
