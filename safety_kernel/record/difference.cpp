#include "record/difference.hpp"

#include <cstdio>
#include <cstring>
#include <type_traits>

#include "io/journal.hpp"

namespace berm::record {

namespace {

struct Field {
  const char* name;
  std::size_t offset, element, count;
  bool is_signed;
};

#define BERM_FIELD(type, field)                                                                                                     \
  {#field, offsetof(type, field), sizeof(std::remove_all_extents_t<decltype(type::field)>),                                        \
   sizeof(type::field) / sizeof(std::remove_all_extents_t<decltype(type::field)>), std::is_signed_v<std::remove_all_extents_t<decltype(type::field)>>}

constexpr Field kDecision[] = {
    BERM_FIELD(berm_decision, cycle),           BERM_FIELD(berm_decision, time_us),           BERM_FIELD(berm_decision, kernel_state),
    BERM_FIELD(berm_decision, stop_reason),     BERM_FIELD(berm_decision, stop_category),     BERM_FIELD(berm_decision, commanded_urad_s),
    BERM_FIELD(berm_decision, request_result),  BERM_FIELD(berm_decision, request_sequence),  BERM_FIELD(berm_decision, phase),
    BERM_FIELD(berm_decision, requested_urad_s), BERM_FIELD(berm_decision, joint_angle_urad), BERM_FIELD(berm_decision, joint_velocity_urad_s),
    BERM_FIELD(berm_decision, permitted_low_urad_s), BERM_FIELD(berm_decision, permitted_high_urad_s),
    BERM_FIELD(berm_decision, reach_low_urad),  BERM_FIELD(berm_decision, reach_high_urad),   BERM_FIELD(berm_decision, slices),
    BERM_FIELD(berm_decision, cells),           BERM_FIELD(berm_decision, blocked_x_mm),      BERM_FIELD(berm_decision, blocked_y_mm),
    BERM_FIELD(berm_decision, blocked_height_mm), BERM_FIELD(berm_decision, scan_points)};

constexpr Field kState[] = {
    BERM_FIELD(berm_state, cycle),            BERM_FIELD(berm_state, time_us),           BERM_FIELD(berm_state, joint_angle_urad),
    BERM_FIELD(berm_state, joint_velocity_urad_s), BERM_FIELD(berm_state, pan_angle_urad), BERM_FIELD(berm_state, payload_kg),
    BERM_FIELD(berm_state, cylinder_kpa), BERM_FIELD(berm_state, request_sequence), BERM_FIELD(berm_state, request_result),
    BERM_FIELD(berm_state, kernel_state),     BERM_FIELD(berm_state, stop_reason),       BERM_FIELD(berm_state, stop_category),
    BERM_FIELD(berm_state, commanded_urad_s), BERM_FIELD(berm_state, permitted_low_urad_s), BERM_FIELD(berm_state, permitted_high_urad_s),
    BERM_FIELD(berm_state, reach_low_urad),    BERM_FIELD(berm_state, reach_high_urad),
    BERM_FIELD(berm_state, blocked_x_mm),     BERM_FIELD(berm_state, blocked_y_mm),      BERM_FIELD(berm_state, blocked_height_mm),
    BERM_FIELD(berm_state, blocked_link),     BERM_FIELD(berm_state, stop_count),        BERM_FIELD(berm_state, cycle_cpu_us),
    BERM_FIELD(berm_state, panel),            BERM_FIELD(berm_state, journal_lost),      BERM_FIELD(berm_state, terrain_confirmed_ms),
    BERM_FIELD(berm_state, unwatched),        BERM_FIELD(berm_state, separation_bearing_deg), BERM_FIELD(berm_state, separation_stop_ms),
    BERM_FIELD(berm_state, dust_permille),   BERM_FIELD(berm_state, sight),               BERM_FIELD(berm_state, reserved)};

template <std::size_t N>
constexpr std::size_t total(const Field (&fields)[N]) {
  std::size_t bytes = 0;
  for (const Field& field : fields) bytes += field.element * field.count;
  return bytes;
}
static_assert(total(kDecision) == sizeof(berm_decision) && total(kState) == sizeof(berm_state), "every field is compared");

std::string value(const std::uint8_t* from, const Field& field) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, from, field.element);
  const unsigned shift = 64U - 8U * static_cast<unsigned>(field.element);
  return field.is_signed ? std::to_string(static_cast<std::int64_t>(bits << shift) >> shift) : std::to_string(bits);
}

template <std::size_t N>
std::optional<Difference> compare(const char* what, const Field (&fields)[N], const void* recorded, const void* replayed) {
  const auto* a = static_cast<const std::uint8_t*>(recorded);
  const auto* b = static_cast<const std::uint8_t*>(replayed);
  for (const Field& field : fields) {
    for (std::size_t i = 0; i < field.count; ++i) {
      const std::size_t at = field.offset + i * field.element;
      if (std::memcmp(a + at, b + at, field.element) == 0) continue;
      const std::string index = field.count > 1 ? "[" + std::to_string(i) + "]" : "";
      return Difference{std::string(what) + "." + field.name + index, value(a + at, field), value(b + at, field)};
    }
  }
  return std::nullopt;
}

std::string text(const berm_can_frame& frame) {
  char line[64];
  int n = std::snprintf(line, sizeof line, "%08X#", frame.id);
  for (int i = 0; i < frame.length && i < 8; ++i) n += std::snprintf(line + n, sizeof line - static_cast<std::size_t>(n), "%02X", frame.data[i]);
  return line;
}

std::optional<Difference> compare(const kernel::FrameList& recorded, const kernel::FrameList& replayed) {
  for (int i = 0; i < recorded.count && i < replayed.count; ++i) {
    const std::string a = text(recorded.frame[i]), b = text(replayed.frame[i]);
    if (a != b) return Difference{"frame " + std::to_string(i) + " out", a, b};
  }
  if (recorded.count == replayed.count) return std::nullopt;
  return Difference{"frames out", std::to_string(recorded.count), std::to_string(replayed.count)};
}

std::string hexadecimal(std::uint64_t hash) {
  char line[24];
  std::snprintf(line, sizeof line, "%016llx", static_cast<unsigned long long>(hash));
  return line;
}

}  // namespace

std::optional<Difference> first_difference(const RecordedOutputs& recorded, const kernel::CycleOutputs& replayed, const sk_height_map& map) {
  if (auto found = compare("decision", kDecision, &recorded.decision, &replayed.decision)) return found;
  if (auto found = compare(recorded.frames, replayed.frames)) return found;
  if (auto found = compare("state", kState, &recorded.state, &replayed.state)) return found;
  const int row = kernel::map_row_of(replayed.decision.cycle);
  const std::uint64_t hash = kernel::map_row_hash(map, row);
  if (hash == recorded.map_row_hash) return std::nullopt;
  return Difference{"map row " + std::to_string(row), hexadecimal(recorded.map_row_hash), hexadecimal(hash)};
}

}  // namespace berm::record
