#include "record/replay.hpp"

#include <memory>

#include "io/parameter_loader.hpp"
#include "record/journal_file.hpp"
#include "journal/mcap_reader.hpp"

namespace berm::record {

namespace {

constexpr std::uint64_t kProgressEvery = 500;

class Replay {
 public:
  Replay(const std::string& path, const std::string& parameters, const std::function<void(std::uint64_t)>& progress, ReplayResult& result)
      : path_(path), other_parameters_(parameters), progress_(progress), result_(result) {}

  bool run(std::string& error) {
    if (!reader_.open(path_)) {
      error = reader_.error();
      return false;
    }
    McapItem item;
    McapReader::Result got;
    while ((got = reader_.next(item)) == McapReader::Result::kItem) {
      if (!take(item, error)) {
        error = path_ + ": " + error;
        return false;
      }
    }
    error = reader_.error();
    if (got == McapReader::Result::kBad) return false;
    if (cycle_ == nullptr && !have_block_) {
      if (error.empty()) error = path_ + ": no journal of the kernel";
      return false;
    }
    finish(got == McapReader::Result::kCut);
    error.clear();
    return true;
  }

 private:
  void finish(bool cut) {
    result_.complete = !cut && ended_;
    if (cut) result_.incomplete_why = reader_.error();
    else if (!ended_) result_.incomplete_why = path_ + ": no end of the journal in it";
    else if (end_cycles_ != result_.cycles) {
      result_.complete = false;
      result_.incomplete_why = path_ + ": its end counts " + std::to_string(end_cycles_) + " cycles, it has " + std::to_string(result_.cycles);
    }
    if (end_lost_ > result_.lost) result_.lost = end_lost_;
  }

  bool take(const McapItem& item, std::string& error) {
    if (item.kind == McapItem::Kind::kMetadata) return take_metadata(item, error);
    if (item.kind == McapItem::Kind::kAttachment) return item.name != names::kParameters || take_parameters(item, error);
    return item.name != names::kCycleTopic || item.encoding != names::kCycleEncoding || take_cycle(item, error);
  }

  bool take_metadata(const McapItem& item, std::string& error) {
    if (item.name == names::kStart) {
      have_start_ = read_start(item.map, start_, error);
      return have_start_;
    }
    if (item.name != names::kEnd) return true;
    ended_ = read_number(item.map, "cycles", end_cycles_) && read_number(item.map, "lost", end_lost_);
    if (!ended_) error = std::string(names::kEnd) + ": cycles or lost is no number";
    return ended_;
  }

  bool take_parameters(const McapItem& item, std::string& error) {
    have_block_ = cycle_ == nullptr && kernel::parse_parameters(names::kParameters, item.bytes, item.size, parameters_, error);
    if (cycle_ != nullptr) error = "a second parameter block";
    return have_block_ && (other_parameters_.empty() || kernel::load_parameters(other_parameters_, parameters_, error));
  }

  bool take_cycle(const McapItem& item, std::string& error) {
    if (cycle_ == nullptr) {
      if (!have_start_ || !have_block_) {
        error = "a cycle before the start conditions and the parameter block";
        return false;
      }
      cycle_ = std::make_unique<kernel::Cycle>(parameters_, start_.map_only);
    }
    if (!decode_cycle(item.bytes, item.size, start_.mount, *in_, recorded_, error)) return false;
    if (recorded_.sequence < next_sequence_) {
      error = "record " + std::to_string(recorded_.sequence) + " comes twice";
      return false;
    }
    result_.lost += recorded_.sequence - next_sequence_;
    next_sequence_ = recorded_.sequence + 1;
    if (result_.cycles == 0) result_.first_us = in_->now_us;
    result_.last_us = in_->now_us;
    ++result_.cycles;
    if (result_.lost > 0) {
      ++result_.not_replayed;
    } else {
      step();
    }
    if (progress_ && result_.cycles % kProgressEvery == 0) progress_(result_.cycles);
    return true;
  }

  void step() {
    cycle_->step(*in_, *out_);
    ++result_.decisions;
    result_.frames += static_cast<std::uint64_t>(in_->frame_count);
    result_.scan_packets += static_cast<std::uint64_t>(in_->packet_count);
    result_.lidar_packets += static_cast<std::uint64_t>(in_->vlp16_count + in_->lidar_count);
    auto difference = first_difference(recorded_, *out_, cycle_->map());
    if (!difference) return;
    if (++result_.mismatches > 1) return;
    result_.first = std::move(difference);
    result_.first_cycle = in_->cycle;
    result_.first_difference_us = in_->now_us;
  }

  const std::string& path_;
  const std::string& other_parameters_;
  const std::function<void(std::uint64_t)>& progress_;
  ReplayResult& result_;
  McapReader reader_;
  StartConditions start_;
  berm_parameters parameters_{};
  bool have_start_ = false, have_block_ = false, ended_ = false;
  std::uint64_t end_cycles_ = 0, end_lost_ = 0, next_sequence_ = 0;
  std::unique_ptr<kernel::Cycle> cycle_;
  std::unique_ptr<kernel::CycleInputs> in_ = std::make_unique<kernel::CycleInputs>();
  std::unique_ptr<kernel::CycleOutputs> out_ = std::make_unique<kernel::CycleOutputs>();
  RecordedOutputs recorded_;
};

}  // namespace

bool replay(const std::string& path, const std::string& parameters, const std::function<void(std::uint64_t)>& progress, ReplayResult& result, std::string& error) {
  return Replay(path, parameters, progress, result).run(error);
}

}  // namespace berm::record
