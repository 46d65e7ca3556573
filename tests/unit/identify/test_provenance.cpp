// Where a table is from: a text that every reader takes, whatever was asked and whatever the machine is called.
#include <gtest/gtest.h>

#include "config/machine_file.hpp"
#include "config/strict_table.hpp"
#include "identify/machine_file_text.hpp"
#include "identify/provenance_text.hpp"
#include "identify/result_text.hpp"
#include "scratch.hpp"

namespace berm::identify::test {
namespace {

Result boom_stick_bucket() {
  Result r;
  r.machine_path = BERM_MACHINE_FILE;
  r.machine_name = "zx200";
  r.joints = {1, 2, 3};
  r.columns = {1, 2, 3, 4, 5, 6};
  r.stops = 1234;
  r.weighed_kg = 1801.0;
  for (const std::size_t j : r.joints) {
    r.bounds.table[j].assign(4, std::vector<TableEntry>(8));
    for (auto& row : r.bounds.table[j])
      for (std::size_t k = 1; k < row.size(); ++k) row[k].angle = row[k].time = 0.5 * static_cast<double>(k);  // as stops that a machine could make
    r.bounds.table[j][0][7].extrapolated = true;
  }
  return r;
}

TEST(Provenance, AShortCommandIsWhole) {
  EXPECT_EQ(provenance_text("berm identify --seed 1", "5 stops"), "measured in simulation: berm identify --seed 1; 5 stops");
  const std::string found(170, 'f');
  EXPECT_EQ(provenance_text("abcd", found), "measured in simulation: abcd; " + found) << "exactly as long as may be";
}

TEST(Provenance, ALongCommandIsCutBetweenWordsAndSaysSo) {
  const std::string text = provenance(boom_stick_bucket());
  EXPECT_LE(text.size(), config::kLongestText) << text;
  EXPECT_EQ(text, "measured in simulation: berm identify --machine zx200 --seed 1 --repetitions 1 --allowance 0.1 --joint boom --joint stick --joint bucket ...; 1234 stops, "
                  "1800 kg weighed; in part extrapolated");
}

TEST(Provenance, EveryNameIsReadAsItIs) {
  const berm::test::Scratch scratch;
  for (const std::string& name : {std::string("zx \"200\" \\u0041"), std::string("two\nlines\x7f"), std::string(200, 'x'), std::string("na\xc3\xafve")}) {
    Result r = boom_stick_bucket();
    r.machine_name = name;
    const std::string path = scratch.write("machine.toml", machine_text(r, config::load_machine_file(r.machine_path)));
    EXPECT_EQ(config::load_machine_file(path).braking.provenance, provenance(r)) << name;
  }
}

}  // namespace
}  // namespace berm::identify::test
