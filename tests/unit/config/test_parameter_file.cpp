// The block as a file: written whole or not at all, and no changed bit is taken.
#include <gtest/gtest.h>

#include <cstring>

#include "config/compile_parameters.hpp"
#include "config/strict_table.hpp"
#include "edited_file.hpp"

namespace berm::config::test {
namespace {

berm_parameters block() { return compile_parameters(load_machine_file(machine_path()), load_site_file(site_path())); }

std::string bytes_of(const berm_parameters& p) { return {reinterpret_cast<const char*>(&p), sizeof p}; }

// verifies: IF-CF-3, IF-CF-14
TEST(ParameterFile, SavedAndLoadedAgain) {
  const Scratch scratch;
  const berm_parameters p = block();
  save_parameters(p, scratch.path("block"));
  EXPECT_EQ(scratch.names(), std::vector<std::string>{"block"}) << "the temporary file is gone";
  EXPECT_EQ(read_text(scratch.path("block")), bytes_of(p));
  EXPECT_EQ(bytes_of(load_parameters(scratch.path("block"))), bytes_of(p));
}

// verifies: IF-CF-14
TEST(ParameterFile, WhatCannotBeWrittenLeavesEverythingAsItWas) {
  const Scratch scratch;
  for (const std::string& path : {scratch.path("no_such_folder/block"), scratch.path("")}) {
    try {
      save_parameters(block(), path);
      ADD_FAILURE() << path << ": written";
    } catch (const ConfigError& error) {
      EXPECT_EQ(std::string(error.what()).find(path + ": cannot be written"), 0u) << error.what();
    }
  }
  EXPECT_TRUE(scratch.names().empty());
}

// verifies: IF-CF-4
TEST(ParameterFile, EveryFlippedBitIsDetected) {
  berm_parameters p = block();
  std::string bytes = bytes_of(p);
  const auto valid = [&bytes, &p] {  // what load_parameters checks, without a file for each bit
    std::memcpy(&p, bytes.data(), sizeof p);
    return p.magic == BERM_PARAMETERS_MAGIC && p.version == BERM_PARAMETERS_VERSION && p.crc32 == parameters_crc(p);
  };
  ASSERT_TRUE(valid());
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    const auto mask = static_cast<char>(1u << (bit % 8));
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ mask);
    EXPECT_FALSE(valid()) << "bit " << bit;
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ mask);
  }
}

// verifies: IF-CF-4
TEST(ParameterFile, EveryByteOfTheFileIsChecked) {
  const Scratch scratch;
  std::string bytes = bytes_of(block());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string bad = bytes;
    bad[i] = static_cast<char>(bad[i] ^ (1 << (i % 8)));
    const std::string path = scratch.write("block", bad);
    EXPECT_THROW(load_parameters(path), ConfigError) << "byte " << i;
  }
}

// verifies: IF-CF-3, IF-CF-4
TEST(ParameterFile, OtherSizesAndOtherFiles) {
  const Scratch scratch;
  const std::string good = bytes_of(block());
  for (const std::string& text : {std::string(), good.substr(0, good.size() - 1), good + '\0', good + good, read_text(machine_path())}) {
    const std::string path = scratch.write("block", text);
    try {
      load_parameters(path);
      ADD_FAILURE() << text.size() << " bytes: taken";
    } catch (const ConfigError& error) {
      EXPECT_EQ(std::string(error.what()).find(path + ": size"), 0u) << error.what();
    }
  }
  EXPECT_THROW(load_parameters(scratch.path("missing")), ConfigError);
}

// verifies: IF-CF-15
TEST(ParameterFile, ShownWithEveryField) {
  const berm_parameters p = block();
  const std::string text = describe(p);
  for (const char* field : {"boom_pin_x_mm", "joint_low_urad", "brake_angle_urad", "brake_time_us", "part[3]", "scanner[1]", "dig_zone[0]", "standstill_us", "crc32"})
    EXPECT_NE(text.find(field), std::string::npos) << field;
  EXPECT_NE(text.find("1797166"), std::string::npos) << "the longest braking angle";
}

}  // namespace
}  // namespace berm::config::test
