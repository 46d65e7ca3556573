// The parameter loader refuses a block that fails in one point, says why in one line, and leaves what it had.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <vector>

#include "core/crc32.h"
#include "io/parameter_loader.hpp"
#include "mini_machine.hpp"

namespace berm::kernel {
namespace {

class ParameterLoader : public ::testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/berm-parameters-XXXXXX";
    close(mkstemp(name));
    path = name;
    block = berm::test::demo_parameters();
  }
  void TearDown() override { unlink(path.c_str()); }

  void write(const void* bytes, std::size_t size) const {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    ASSERT_EQ(std::fwrite(bytes, 1, size, file), size);
    std::fclose(file);
  }
  void write_block(bool new_crc) {
    if (new_crc) block.crc32 = static_cast<std::int32_t>(sk_crc32(reinterpret_cast<const std::uint8_t*>(&block), offsetof(berm_parameters, crc32)));
    write(&block, sizeof block);
  }
  void expect_refused(const char* with) {
    berm_parameters loaded;
    std::memset(&loaded, 0x5A, sizeof loaded);
    const berm_parameters before = loaded;
    std::string error;
    EXPECT_FALSE(load_parameters(path, loaded, error));
    EXPECT_EQ(error.find(path), 0U) << error;
    EXPECT_NE(error.find(with), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos);
    EXPECT_EQ(std::memcmp(&loaded, &before, sizeof loaded), 0);
  }

  // What is told of a block with this byte damaged: magic and version are asked for before the CRC.
  static const char* reason(std::size_t byte) {
    if (byte < offsetof(berm_parameters, magic) + sizeof block.magic) return "magic";
    return byte < offsetof(berm_parameters, version) + sizeof block.version ? "version" : "CRC";
  }

  std::string path;
  berm_parameters block{};
};

// verifies: SK-CY-60
TEST_F(ParameterLoader, TakesAGoodBlock) {
  write_block(false);
  berm_parameters loaded{};
  std::string error;
  ASSERT_TRUE(load_parameters(path, loaded, error)) << error;
  EXPECT_EQ(std::memcmp(&loaded, &block, sizeof block), 0);
}

// verifies: SK-CY-60
TEST_F(ParameterLoader, RefusesEveryWrongSize) {
  std::vector<char> bytes(sizeof block + 1);
  std::memcpy(bytes.data(), &block, sizeof block);
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, sizeof block - 4, sizeof block - 1, sizeof block + 1}) {
    write(bytes.data(), size);
    expect_refused("bytes");
  }
}

// verifies: SK-CY-60
TEST_F(ParameterLoader, RefusesEverySingleBitFlip) {
  for (std::size_t bit = 0; bit < sizeof block * 8; bit += 7) {
    reinterpret_cast<std::uint8_t*>(&block)[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
    write_block(false);
    expect_refused(reason(bit / 8));
    reinterpret_cast<std::uint8_t*>(&block)[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
  }
}

// verifies: SK-CY-60
TEST_F(ParameterLoader, NamesWhatIsWrongThoughTheCrcIsRight) {
  block.magic += 1;
  write_block(true);
  expect_refused("magic");
  block.magic = BERM_PARAMETERS_MAGIC;
  block.version = 2;
  write_block(true);
  expect_refused("version");
  block.version = BERM_PARAMETERS_VERSION;
  block.brake_angle_urad[0][0][3] = block.brake_angle_urad[0][0][2] - 1;
  write_block(true);
  expect_refused("rule");
}

// verifies: SK-CY-60
TEST_F(ParameterLoader, RefusesAFileThatIsNotThere) {
  write_block(false);
  unlink(path.c_str());
  expect_refused("No such file");
}

}  // namespace
}  // namespace berm::kernel
