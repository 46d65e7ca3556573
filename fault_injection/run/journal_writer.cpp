#include "run/journal_writer.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "run/patience.hpp"

namespace berm::run {

namespace {

constexpr int kFileDescriptor = 13;  // numbers in the child
constexpr int kPaceDescriptor = 14;

}  // namespace

void JournalWriter::start(const std::string& file, const RunFolder& folder, const Uids& uids, int pace) {
  file_ = file;
  const std::string part = file + ".part";
  const int opened = open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (opened < 0) throw std::system_error(errno, std::generic_category(), part);
  ChildOptions journal;
  journal.program = program_folder() + "/berm_journal";
  journal.arguments = {"--socket", folder.file("kernel.sock"), "--file-fd", std::to_string(kFileDescriptor)};
  journal.descriptors = {{opened, kFileDescriptor}};
  if (pace >= 0) {
    journal.arguments.insert(journal.arguments.end(), {"--pace-fd", std::to_string(kPaceDescriptor)});
    journal.descriptors.push_back({pace, kPaceDescriptor});
  }
  if (uids.separate) journal.uid = uids.journal;
  process_.start(journal);
  close(opened);
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(kConnectPatience_s);
  while (process_.take_lines().empty()) {
    if (process_.ended()) throw std::runtime_error("the journal's writer did not start: " + process_.describe_end());
    if (std::chrono::steady_clock::now() > until) throw std::runtime_error("the journal's writer did not connect to the kernel");
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

bool JournalWriter::finish(std::uint64_t& lost) {
  if (!process_.wait_ended(kEndPatience_s)) {
    process_.signal(SIGKILL);
    process_.wait_ended(kEndPatience_s);
  }
  const auto report = nlohmann::json::parse(last_json_line(process_.take_lines()), nullptr, false);
  if (process_.exit_status() != 0 || !report.is_object() || !report.contains("lost")) return false;
  std::filesystem::rename(file_ + ".part", file_);
  lost = report.value("lost", std::uint64_t{0});
  return true;
}

}  // namespace berm::run
