#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "plant/process/output_file.hpp"
#include "plant/process/run_record.hpp"
#include "plant/process/trace_writer.hpp"
#include "scratch.hpp"

namespace berm::plant::testing {
namespace {

std::string text_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST(OutputFile, AppearsOnlyWhenFinished) {
  const test::Scratch scratch;
  const std::string path = scratch.path("output");
  {
    OutputFile file(path);
    file.write("half");
    EXPECT_FALSE(std::filesystem::exists(path));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
  OutputFile file(path);
  file.write("whole");
  file.finish();
  EXPECT_EQ(text_of(path), "whole");
  EXPECT_THROW(OutputFile("/nonexistent/folder/file"), std::runtime_error);
}

TEST(TraceWriter, HasTheDocumentedColumnsAndFormat) {
  const test::Scratch scratch;
  const std::string path = scratch.path("trace.csv");
  const std::vector<MoverPose> movers{{"truck_1", 1.0, -2.0, 0.5, 3.0, true}};
  TraceWriter trace(path, movers);
  JointState joints;
  joints.angle = {0.1, -0.2, 0.3, -1e-9};
  berm_heartbeat heartbeat{};
  heartbeat.kernel_state = 3;
  heartbeat.stop_reason = 9;
  trace.row(0.01, joints, heartbeat, {1500.5, 3000.25, 12.0}, 0.25, movers);
  EXPECT_THROW(trace.row(0.02, joints, heartbeat, {}, 0, {}), std::runtime_error);
  trace.finish();
  EXPECT_EQ(text_of(path),
            "time_s,swing_rad,boom_rad,stick_rad,bucket_rad,swing_rad_s,boom_rad_s,stick_rad_s,bucket_rad_s,stop_state,stop_reason,payload_kg,"
            "in_trucks_kg,spilled_kg,clearance_m,truck_1_x_m,truck_1_y_m,truck_1_z_m,truck_1_yaw_rad\n"
            "0.010000,0.100000,-0.200000,0.300000,0.000000,0.000000,0.000000,0.000000,0.000000,3,9,1500.500000,3000.250000,12.000000,0.250000,1.000000,-2.000000,0.500000,"
            "3.000000\n");
}

OracleVerdict verdict(bool contact, double closest_m, const std::string& what) {
  OracleVerdict v;
  v.contact = contact;
  v.closest_m = closest_m;
  v.ground_gap_m = 0.5 - 0.1 * closest_m;
  v.what = what;
  return v;
}

nlohmann::json written(const RunRecord& record, const RunRecord::End& end) {
  const test::Scratch scratch;
  const std::string path = scratch.path("truth.json");
  record.write(path, end);
  return nlohmann::json::parse(text_of(path));
}

TEST(RunRecord, CountsContactEpisodesAndTheClosestApproach) {
  RunRecord record;
  EXPECT_FALSE(record.judge(0.01, verdict(false, 2.0, "ground")));
  EXPECT_FALSE(record.judge(0.02, verdict(false, 0.4, "truck_1 wall")));
  EXPECT_TRUE(record.judge(0.03, verdict(true, 0.0, "truck_1 wall")));
  EXPECT_FALSE(record.judge(0.04, verdict(true, 0.0, "truck_1 wall")));
  EXPECT_FALSE(record.judge(0.05, verdict(false, 0.1, "truck_1 wall")));
  EXPECT_TRUE(record.judge(0.06, verdict(true, 0.0, "person")));
  const auto j = written(record, {});
  EXPECT_EQ(j.at("contacts"), 2);
  EXPECT_EQ(j.at("contact_list")[1].at("what"), "person");
  EXPECT_EQ(j.at("contact_list")[1].at("time_s"), 0.06);
  EXPECT_EQ(j.at("closest_approach_m"), 0.0);
  EXPECT_EQ(j.at("closest_approach_time_s"), 0.03);
  EXPECT_EQ(j.at("least_ground_gap_m"), 0.3);
}

TEST(RunRecord, StandstillCountsFromTheFirstFaultOnly) {
  RunRecord record;
  record.standstill(1.0, true);
  record.fault(2.0, "app gone");
  record.fault(2.5, "kernel gone");
  record.standstill(2.1, false);
  record.standstill(3.0, true);
  record.standstill(4.0, true);
  const auto j = written(record, {});
  EXPECT_EQ(j.at("fault"), "app gone");
  EXPECT_EQ(j.at("fault_s"), 2.0);
  EXPECT_EQ(j.at("first_standstill_after_fault_s"), 3.0);
}

TEST(RunRecord, LoadsAndSpill) {
  RunRecord record;
  Truth truth;
  truth.truck_load_kg = {17900.0, 0.0};
  truth.load_centre_offset_m = 0.12;
  record.truck_left(300.0, truth);
  RunRecord::End end;
  end.truth = truth;
  end.truth.dug_kg = 20000.0;
  end.truth.spilled_kg = 500.0;
  end.truth.load_centre_offset_m = 0.0;  // the second has only just come
  const auto j = written(record, end);
  EXPECT_EQ(j.at("load_centre_offset_m"), 0.12) << "of the truck that was loaded last";
  end.truth.truck_load_kg[1] = 1500.0;
  end.truth.load_centre_offset_m = 0.4;
  EXPECT_EQ(written(record, end).at("load_centre_offset_m"), 0.4);
  EXPECT_EQ(j.at("trucks_left").size(), 1u);
  EXPECT_EQ(j.at("trucks_left")[0].at("load_kg"), 17900.0);
  EXPECT_EQ(j.at("spill_fraction"), 0.025);
  EXPECT_TRUE(j.at("fault_s").is_null());
  EXPECT_TRUE(written(RunRecord(), {}).at("closest_approach_m").is_null());
}

}  // namespace
}  // namespace berm::plant::testing
