#include <gtest/gtest.h>

#include <fstream>

#include "config/machine_file.hpp"
#include "run/kernel_session.hpp"
#include "run/scenario_names.hpp"
#include "watch/watched_files.hpp"

namespace berm::watch {
namespace {

const std::string text = "name = \"a\"\n[tail]\nwatched = false  # no sensor\n[workspace] # who\nradius = 12.0\n  watched = false\n[[part]]\nwatched = 3\n";

TEST(watched_files, a_value_is_replaced_in_its_table_alone) {
  EXPECT_EQ(with_value(text, "workspace", "watched", "true"),
            "name = \"a\"\n[tail]\nwatched = false  # no sensor\n[workspace] # who\nradius = 12.0\nwatched = true\n[[part]]\nwatched = 3\n");
  EXPECT_EQ(with_value(text, "", "name", "\"b\"").substr(0, 11), "name = \"b\"\n");
}

TEST(watched_files, a_key_that_is_not_there_is_named) {
  for (const auto& [table, key] : {std::pair{"workspace", "wide"}, {"tail", "radius"}, {"nowhere", "watched"}, {"", "watched"}}) {
    try {
      with_value(text, table, key, "1");
      FAIL() << table << " " << key;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(key), std::string::npos);
    }
  }
}

TEST(watched_files, the_shipped_scenario_gets_a_machine_that_watches_and_keeps_all_else) {
  const run::RunFolder folder;
  const WatchedFiles files = write_watched("person", "", false, 45.0, folder.path());
  const auto machine = config::load_machine_file(files.machine);
  EXPECT_TRUE(machine.workspace.watched);
  EXPECT_FALSE(machine.tail.watched);
  EXPECT_EQ(run::scenario_names(files.scenario).machine, files.machine);
  std::ifstream file(files.scenario);
  const std::string all((std::istreambuf_iterator<char>(file)), {});
  EXPECT_NE(all.find("max_time_s = 45.00"), std::string::npos);
  EXPECT_NE(all.find("plant = \"zx200_plant\""), std::string::npos);
  EXPECT_NE(all.find("[[person]]"), std::string::npos);
}

TEST(watched_files, another_machine_comes_with_its_plant) {
  const run::RunFolder folder;
  const WatchedFiles files = write_watched("bench", "zx200_rear", true, {}, folder.path());
  std::ifstream file(files.scenario);
  const std::string all((std::istreambuf_iterator<char>(file)), {});
  EXPECT_NE(all.find("plant = \"zx200_rear_plant\""), std::string::npos);
  EXPECT_NE(all.find("max_time_s = 1800.0"), std::string::npos);
  EXPECT_TRUE(config::load_machine_file(files.machine).workspace.histogram);
  EXPECT_FALSE(config::load_machine_file(write_watched("bench", "zx200_rear", false, {}, folder.path()).machine).workspace.histogram);
}

}  // namespace
}  // namespace berm::watch
