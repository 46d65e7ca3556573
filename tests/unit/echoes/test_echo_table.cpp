#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "echoes/echo_picture.hpp"
#include "echoes/echo_table.hpp"
#include "scratch.hpp"

namespace berm::echoes {
namespace {

using plant::Ranging;

EchoSample rear_sample(double truth, double range, int echoes, double cloud_from = 0.0) {
  EchoSample s;
  s.truck = s.rear = true;
  s.truth = truth;
  s.range = range;
  s.echoes = echoes;
  s.cloud_from = cloud_from;
  return s;
}

TEST(EchoTable, CountsEveryKindOfReturnOnce) {
  std::vector<EchoSample> samples{rear_sample(6.0, 6.1, 1), rear_sample(6.0, 5.9, 2, 3.5), rear_sample(6.0, 3.7, 2, 3.5), rear_sample(6.0, 4.9, 1, 3.5),
                                  rear_sample(6.0, 0.0, 0, 3.5)};
  EchoSample ground = rear_sample(5.0, 2.0, 1);
  ground.truck = ground.rear = false;
  samples.push_back(ground);
  const EchoRow row = row_of(samples, Place::about, 0.5, Ranging::last_pulse);
  EXPECT_EQ(row.samples, 5);
  EXPECT_NEAR(row.met, 0.4, 1e-12);
  EXPECT_NEAR(row.front, 0.2, 1e-12);
  EXPECT_NEAR(row.elsewhere, 0.2, 1e-12);
  EXPECT_NEAR(row.none, 0.2, 1e-12);
  EXPECT_NEAR(row.flagged, 0.4, 1e-12);
  EXPECT_NEAR(row.wrong_unflagged, 0.2, 1e-12);
  EXPECT_NEAR(row.median_error_m, -1.1, 1e-9) << "the lower of the middle two of -2.3, -1.1, -0.1, 0.1";
}

// stentz-1999, Figure 8: both range the truck in clear air; in a cloud about it the last pulse is the cloud's front and the trailing edge the truck.
TEST(EchoStage, ATruckInACloudAsInFigure8) {
  const Stage stage({});
  for (const Ranging ranging : {Ranging::last_pulse, Ranging::trailing_edge}) {
    const EchoRow clear = row_of(stage.scan(ranging, Place::about, 0.0, 10), Place::about, 0.0, ranging);
    EXPECT_GT(clear.samples, 200);
    EXPECT_EQ(clear.met, 1.0);
    EXPECT_EQ(clear.flagged, 0.0);
    const EchoRow before = row_of(stage.scan(ranging, Place::before, 0.5, 10), Place::before, 0.5, ranging);
    EXPECT_EQ(before.met, 1.0) << "a cloud apart from the truck is seen through by both";
    EXPECT_EQ(before.flagged, 1.0);
  }
  const EchoRow lead = row_of(stage.scan(Ranging::last_pulse, Place::about, 0.5, 10), Place::about, 0.5, Ranging::last_pulse);
  EXPECT_EQ(lead.front, 1.0);
  EXPECT_EQ(lead.flagged, 1.0);
  const EchoRow trail = row_of(stage.scan(Ranging::trailing_edge, Place::about, 0.5, 10), Place::about, 0.5, Ranging::trailing_edge);
  EXPECT_GT(trail.met, 0.99);
  EXPECT_EQ(trail.flagged, 1.0);
}

TEST(EchoStage, TheSameSeedGivesTheSameReturns) {
  StageOptions o;
  o.range_stddev = 0.03;
  const auto ranges = [](const StageOptions& options) {
    std::vector<double> out;
    for (const EchoSample& s : Stage(options).scan(Ranging::trailing_edge, Place::about, 0.3, 2)) out.push_back(s.range);
    return out;
  };
  const auto first = ranges(o);
  EXPECT_EQ(first, ranges(o));
  o.seed = 2;
  EXPECT_NE(first, ranges(o));
}

TEST(EchoTable, JsonAndPictureSayWhatWasAsked) {
  StageOptions o;
  o.seed = 7;
  const Stage stage(o);
  const std::vector<EchoRow> rows = sweep(stage, {0.5}, 2);
  ASSERT_EQ(rows.size(), 6u);
  const nlohmann::json j = json_of(rows, o, 2);
  EXPECT_EQ(j["seed"], 7);
  ASSERT_EQ(j["rows"].size(), 6u);
  EXPECT_EQ(j["rows"][0]["cloud"], "none");
  EXPECT_EQ(j["rows"][3]["receiver"], "trailing edge");
  EXPECT_EQ(j["rows"][4]["cloud"], "before the truck");
  for (const auto& row : j["rows"])
    EXPECT_NEAR(row["rear_share"].get<double>() + row["front_share"].get<double>() + row["between_share"].get<double>() + row["nothing_share"].get<double>(), 1.0, 1e-9);
  const test::Scratch scratch;
  write_echo_picture(scratch.path("echoes.svg"), stage, o, 0.5);
  std::ifstream in(scratch.path("echoes.svg"));
  std::stringstream text;
  text << in.rdbuf();
  for (const char* words : {"last pulse, clear air", "trailing edge, clear air", "last pulse, dust of 0.5 /m", "trailing edge, dust of 0.5 /m", "as Figure 6", "as Figure 7"})
    EXPECT_NE(text.str().find(words), std::string::npos) << words;
  EXPECT_THROW(write_echo_picture(scratch.path("none/echoes.svg"), stage, o, 0.5), std::runtime_error);
}

}  // namespace
}  // namespace berm::echoes
