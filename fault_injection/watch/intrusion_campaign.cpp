#include "watch/intrusion_campaign.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "in_process/forked_jobs.hpp"
#include "watch/intrusion_line.hpp"

namespace berm::watch {

namespace {

// By the preparation, and the version of MergeCell in it; those that appear soonest first.
std::vector<std::vector<Intrusion>> shared_preparations(const Bench& bench, std::uint64_t seed, When when, int count) {
  std::map<std::pair<int, bool>, std::vector<Intrusion>> shares;
  for (int run = 0; run < count; ++run) {
    const Intrusion intrusion = draw_intrusion(seed, run, bench.intrusion_site, when);
    shares[{preparation_of(run), intrusion.follows}].push_back(intrusion);
  }
  std::vector<std::vector<Intrusion>> all;
  for (auto& [key, trials] : shares) {
    std::stable_sort(trials.begin(), trials.end(), [](const auto& a, const auto& b) { return a.waits_s < b.waits_s; });
    all.push_back(std::move(trials));
  }
  return all;
}

// An alarm of the preparation ends all that were to come: it is the first one's, and counted once.
void run_share(const Bench& bench, const std::vector<Intrusion>& trials, const in_process::Say& say) {
  const Intrusion& first = trials.front();
  Preparation preparation(bench, first.seed, preparation_of(first.run), first.follows, nullptr);
  bool alarm_told = false;
  for (const Intrusion& intrusion : trials) {
    if (preparation.wait(intrusion)) {
      in_process::in_a_copy([&] { say(line_of(preparation.play(intrusion))); });
    } else if (!std::exchange(alarm_told, true)) {
      say(line_of(preparation.play(intrusion)));
    } else {
      IntrusionResult never;
      never.intrusion = intrusion;
      say(line_of(never));
    }
  }
}

}  // namespace

void run_campaign(const Bench& bench, int count, int jobs, Campaign& campaign, const std::function<void(const IntrusionResult&)>& done,
                  const std::function<bool()>& stop) {
  const auto shares = shared_preparations(bench, campaign.seed, campaign.when, count);
  const auto before = [](const IntrusionResult& a, const IntrusionResult& b) { return a.intrusion.run < b.intrusion.run; };
  in_process::run_in_processes(
      static_cast<int>(shares.size()), jobs,
      [&](int share, const in_process::Say& say) { run_share(bench, shares[static_cast<std::size_t>(share)], say); },
      [&](int, const std::string& line) {
        IntrusionResult result = result_of(line, [&](int run) { return draw_intrusion(campaign.seed, run, bench.intrusion_site, campaign.when); });
        const auto at = std::upper_bound(campaign.results.begin(), campaign.results.end(), result, before);
        done(*campaign.results.insert(at, std::move(result)));
      },
      stop);
}

}  // namespace berm::watch
