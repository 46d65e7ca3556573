#include "record/journal_file.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/sk_common.h"
#include "record/decision_json.hpp"

namespace berm::record {

namespace {

constexpr std::uint64_t kNsOfUs = 1000;
constexpr const char* kMountKeys[4] = {"vlp16_x_m", "vlp16_y_m", "vlp16_z_m", "vlp16_yaw_rad"};
constexpr double kMountMax = 1000.0;

std::string exact(double value) {  // hexadecimal: reads back to the very same bits
  char text[40];
  std::snprintf(text, sizeof text, "%a", value);
  return text;
}

}  // namespace

bool JournalFile::begin(const berm_journal_start& start) {
  if (!mcap_.begin("berm_journal " + std::to_string(BERM_JOURNAL_VERSION))) return false;
  const std::uint16_t decision = mcap_.schema("berm.Decision", "jsonschema", decision_schema());
  const std::uint16_t lost = mcap_.schema("berm.Lost", "jsonschema", lost_schema());
  cycle_channel_ = mcap_.channel(0, names::kCycleTopic, names::kCycleEncoding);
  decision_channel_ = mcap_.channel(decision, names::kDecisionTopic, "json");
  lost_channel_ = mcap_.channel(lost, names::kLostTopic, "json");
  TextMap map{{"journal_version", std::to_string(start.version)},
              {"contract_version", std::to_string(start.contract_version)},
              {"cell_mm", std::to_string(start.cell_mm)},
              {"map_only", std::to_string(start.map_only)}};
  for (int i = 0; i < 4; ++i) map[kMountKeys[i]] = exact(start.mount[i]);
  return mcap_.metadata(names::kStart, map) && mcap_.attachment(names::kParameters, "application/octet-stream", 0, &start.parameters, sizeof start.parameters);
}

bool JournalFile::note_lost(std::uint64_t sequence, std::uint64_t before_cycle) {
  if (sequence <= next_sequence_) return true;
  const std::uint64_t gap = sequence - next_sequence_;
  lost_ += gap;
  next_sequence_ = sequence;
  const std::string json = lost_json(gap, before_cycle);
  return mcap_.message(lost_channel_, static_cast<std::uint32_t>(sequence), log_ns_, json.data(), json.size());
}

bool JournalFile::cycle(const std::uint8_t* record, std::size_t size) {
  berm_journal_cycle head;
  if (size < sizeof head) return false;
  std::memcpy(&head, record, sizeof head);
  log_ns_ = static_cast<std::uint64_t>(head.now_us) * kNsOfUs;
  if (!note_lost(head.sequence, head.cycle)) return false;
  ++next_sequence_;
  ++cycles_;
  last_cycle_ = head.cycle;
  const std::string json = decision_json(head.decision);
  const auto sequence = static_cast<std::uint32_t>(head.sequence);
  return mcap_.message(cycle_channel_, sequence, log_ns_, record, size) && mcap_.message(decision_channel_, sequence, log_ns_, json.data(), json.size());
}

bool JournalFile::end(std::uint64_t offered) {
  return note_lost(offered, last_cycle_ + 1) &&
         mcap_.metadata(names::kEnd, {{"cycles", std::to_string(cycles_)}, {"lost", std::to_string(lost_)}, {"offered", std::to_string(offered)}}) && mcap_.end();
}

bool read_number(const TextMap& map, const std::string& key, std::uint64_t& value) {
  const auto found = map.find(key);
  if (found == map.end() || found->second.empty() || found->second.size() > 19 || found->second.find_first_not_of("0123456789") != std::string::npos) return false;
  value = std::strtoull(found->second.c_str(), nullptr, 10);
  return true;
}

bool read_start(const TextMap& map, StartConditions& start, std::string& error) {
  const struct {
    const char* key;
    std::uint64_t expected;
  } versions[] = {{"journal_version", BERM_JOURNAL_VERSION}, {"contract_version", BERM_CONTRACT_VERSION}, {"cell_mm", SK_CELL_MM}};
  std::uint64_t value = 0;
  for (const auto& version : versions) {
    if (!read_number(map, version.key, value) || value != version.expected) {
      const auto found = map.find(version.key);
      error = std::string(version.key) + " is " + (found == map.end() ? "missing" : found->second.substr(0, 20)) + "; this program replays " + std::to_string(version.expected);
      return false;
    }
  }
  if (!read_number(map, "map_only", value) || value > 1) {
    error = "map_only is neither 0 nor 1";
    return false;
  }
  start.map_only = value == 1;
  double* const fields[4] = {&start.mount.x_m, &start.mount.y_m, &start.mount.z_m, &start.mount.yaw_rad};
  for (int i = 0; i < 4; ++i) {
    const auto found = map.find(kMountKeys[i]);
    char* end = nullptr;
    const double read = found == map.end() ? NAN : std::strtod(found->second.c_str(), &end);
    if (found == map.end() || end == found->second.c_str() || *end != '\0' || !(std::fabs(read) <= kMountMax)) {
      error = std::string(kMountKeys[i]) + " is missing or no number within 1000";
      return false;
    }
    *fields[i] = read;
  }
  return true;
}

}  // namespace berm::record
