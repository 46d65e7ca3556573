// berm replay: reproduces every decision of a journal, or names the first that differs.
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "config/one_line.hpp"
#include "config/output_file.hpp"
#include "config/standard_output.hpp"
#include "config/whole_file.hpp"
#include "record/replay.hpp"

namespace {

using namespace berm::record;

constexpr int kNotReproduced = 1, kUnusable = 2;

constexpr const char* kHelp =
    "usage: berm replay FILE [--json FILE] [--parameters FILE]\n"
    "\n"
    "Feeds the inputs of a journal (journal.mcap of berm load --out) to a fresh kernel cycle and compares every decision, every frame sent, the\n"
    "published state and the height map with what was recorded, bit for bit. Names the first cycle and field that differ.\n"
    "\n"
    "  --json FILE        the result as one flat JSON object: cycles, decisions, mismatches, lost, ...\n"
    "  --parameters FILE  another parameter block than the recorded one: what would have been decided then\n"
    "  --help             this text\n"
    "\n"
    "Exit status 0: every decision was reproduced and nothing was lost. 1: not so. 2: the file cannot be used.\n";

int fail(const std::string& error) {
  berm::config::put_error("berm replay: " + error);
  return kUnusable;
}

struct Options {
  std::string file, json, parameters;
};

// Exit status when the program should end now, otherwise -1.
int read_options(int argc, char** argv, Options& options) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--help" || word == "-h") {
      std::fputs(kHelp, stdout);
      return EXIT_SUCCESS;
    }
    if (word == "--json" || word == "--parameters") {
      const std::string value = i + 1 < argc ? argv[++i] : "";
      if (value.empty()) return fail(word + " wants a file (see --help)");
      std::string& file = word == "--json" ? options.json : options.parameters;
      if (!file.empty()) return fail(word + " is given twice (see --help)");
      file = value;
    } else if (word.size() > 1 && word[0] == '-') {
      return fail("unknown option " + word + " (see --help)");
    } else if (word.empty()) {
      return fail("FILE must not be empty (see --help)");
    } else if (!options.file.empty()) {
      return fail("one file at a time, not \"" + word + "\" as well (see --help)");
    } else {
      options.file = word;
    }
  }
  if (options.file.empty()) return fail("which file? (see --help)");
  if (options.json.empty()) return -1;
  if (const std::string why = berm::config::why_not_written(options.json); !why.empty()) return fail("--json: " + options.json + ": " + why);
  for (const std::string& read : {options.file, options.parameters})
    if (!read.empty() && berm::config::same_file(options.json, read)) return fail("--json: " + read + " is read, and would be overwritten");
  return -1;
}

std::string json_of(const ReplayResult& r) {
  std::string json = "{\n";
  const auto add = [&json](const char* name, const std::string& value) { json += (json.size() > 2 ? ",\n  \"" : "  \"") + std::string(name) + "\": " + value; };
  const auto quoted = [](const std::string& text) { return "\"" + text + "\""; };
  add("cycles", std::to_string(r.cycles));
  add("decisions", std::to_string(r.decisions));
  add("mismatches", std::to_string(r.mismatches));
  add("lost", std::to_string(r.lost));
  add("not_replayed", std::to_string(r.not_replayed));
  add("complete", r.complete ? "true" : "false");
  add("first_mismatch_cycle", r.first ? std::to_string(r.first_cycle) : "null");
  add("first_mismatch_field", r.first ? quoted(r.first->field) : "null");
  add("first_mismatch_recorded", r.first ? quoted(r.first->recorded) : "null");
  add("first_mismatch_replayed", r.first ? quoted(r.first->replayed) : "null");
  return json + "\n}\n";
}

void print(const ReplayResult& r, const std::string& file, double seconds) {
  const double recorded = static_cast<double>(r.last_us - r.first_us) * 1e-6;
  const auto n = [](std::uint64_t v) { return static_cast<unsigned long long>(v); };
  std::printf("Replay of %s\n", file.c_str());
  std::printf("  cycles              %llu (%.1f s recorded, replayed in %.1f s)\n", n(r.cycles), recorded, seconds);
  std::printf("  inputs              %llu frames, %llu scan packets, %llu lidar packets\n", n(r.frames), n(r.scan_packets), n(r.lidar_packets));
  std::printf("  decisions           %llu reproduced bit for bit, %llu differ\n", n(r.decisions - r.mismatches), n(r.mismatches));
  std::printf("  records lost        %llu%s\n", n(r.lost), r.lost > 0 ? " (what the kernel decided after the first loss cannot be replayed)" : "");
  if (r.not_replayed > 0) std::printf("  not replayed        %llu cycles behind the loss\n", n(r.not_replayed));
  if (!r.complete) std::printf("  incomplete          %s\n", r.incomplete_why.c_str());
  if (!r.first) return;
  std::printf("  first difference    cycle %llu (%.2f s), %s\n", n(r.first_cycle), static_cast<double>(r.first_difference_us) * 1e-6, r.first->field.c_str());
  std::printf("    recorded          %s\n    replayed          %s\n", r.first->recorded.c_str(), r.first->replayed.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  berm::config::watch_standard_output("berm replay");
  Options options;
  if (const int status = read_options(argc, argv, options); status >= 0) return status;
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const auto progress = [terminal](std::uint64_t cycles) {
    if (terminal) std::fprintf(stderr, "\r  %llu cycles", static_cast<unsigned long long>(cycles));
  };
  ReplayResult result;
  std::string error;
  const auto begin = std::chrono::steady_clock::now();
  const bool usable = replay(options.file, options.parameters, progress, result, error);
  if (terminal) std::fputs("\r                        \r", stderr);
  if (!usable) return fail(error);
  print(result, options.file, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  if (!options.json.empty()) try {
    berm::config::write_whole_file(options.json, json_of(result));
  } catch (const std::runtime_error& wrong) {
    return fail(wrong.what());
  }
  return result.reproduced() ? EXIT_SUCCESS : kNotReproduced;
}
