// berm_journal: the journal's writer. A process of its own, under a uid of its own: it reads the kernel's ring and writes the file.
#include <fcntl.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "config/one_line.hpp"
#include "config/output_file.hpp"
#include "config/standard_output.hpp"
#include "record/journal_file.hpp"
#include "record/kernel_link.hpp"
#include "record/ring_reader.hpp"

namespace {

using namespace berm::record;

constexpr const char* kPart = ".part";  // of a file that is not complete
constexpr int kPollMs = 5;  // the ring holds more than a hundred times what the kernel makes in that time

constexpr const char* kHelp =
    "usage: berm_journal --socket PATH (--out FILE | --file-fd N) [--pace-fd N]\n"
    "\n"
    "Writes the kernel's journal as an MCAP file until the kernel ends.\n"
    "\n"
    "  --socket PATH  the kernel's socket; the kernel must have been started with --journal-uid and this process's uid\n"
    "  --out FILE     written as FILE.part, renamed when complete\n"
    "  --file-fd N    an open, empty file instead; whoever opened it renames it when this process has ended with status 0\n"
    "  --pace-fd N    simulation only: an open SOCK_SEQPACKET that is sent the newest cycle taken (uint64), so that a plant in lockstep can wait\n"
    "  --help         this text\n"
    "\n"
    "At the kernel's end it prints one line of JSON: cycles, lost, bytes. Status 0 when the file is complete (lost records do not change that).\n";

int fail(const std::string& error) {
  berm::config::put_error("berm_journal: " + error);
  return EXIT_FAILURE;
}

struct Options {
  std::string socket, out;
  int fd = -1, pace = -1;
};

// False for what is not a number of a descriptor.
bool read_descriptor(const std::string& text, int& fd) {
  if (text.size() > 4 || text.find_first_not_of("0123456789") != std::string::npos) return false;
  fd = std::atoi(text.c_str());
  return true;
}

// Why the journal cannot be written there, before the kernel's ring is taken: at its end it would be too late. Empty when it can.
std::string why_not_out(const std::string& out) {
  if (const std::string why = berm::config::why_not_written(out); !why.empty()) return why;
  struct stat status {};
  if (stat(out.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) return "is no regular file, and would be replaced by one";
  const std::string part = berm::config::why_not_written(out + kPart);
  return part.empty() ? "" : "its " + std::string(kPart) + " file " + part;
}

// Exit status when the program should end now, otherwise -1.
int read_options(int argc, char** argv, Options& options) {
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    if (name == "--help" || name == "-h") {
      std::fputs(kHelp, stdout);
      return EXIT_SUCCESS;
    }
    if (name != "--socket" && name != "--out" && name != "--file-fd" && name != "--pace-fd") return fail("unknown option " + name + "; --help lists them");
    const std::string value = i + 1 < argc ? argv[++i] : "";
    if (value.empty()) return fail(name + " must not be empty");
    if (name == "--socket" || name == "--out") {
      std::string& path = name == "--socket" ? options.socket : options.out;
      if (!path.empty()) return fail(name + " is given twice");
      path = value;
      continue;
    }
    if (!read_descriptor(value, name == "--file-fd" ? options.fd : options.pace))
      return fail(name + " must be a file descriptor from 0 to 9999, not \"" + value + "\"");
  }
  if (options.socket.empty()) return fail("--socket is required");
  if (options.out.empty() == (options.fd < 0)) return fail("either --out or --file-fd is required");
  if (options.out.empty()) return -1;
  if (const std::string why = why_not_out(options.out); !why.empty()) return fail("--out: " + options.out + ": " + why);
  return -1;
}

// Who listens reads all that is there: one that could not be sent is behind a newer one, or nobody listens.
void tell_pace(int fd, std::uint64_t cycle) {
  while (send(fd, &cycle, sizeof cycle, MSG_DONTWAIT | MSG_NOSIGNAL) < 0 && errno == EINTR) {
  }
}

// The name that a descriptor was opened under, for messages.
std::string name_of(int fd) {
  char name[4096];
  const ssize_t size = readlink(("/proc/self/fd/" + std::to_string(fd)).c_str(), name, sizeof name);
  return size > 0 ? std::string(name, static_cast<std::size_t>(size)) : "the journal's file";
}

// Until the kernel is gone and the ring is empty. False with one line in error.
bool follow(KernelLink& link, JournalFile& file, int pace, std::string& error) {
  RingReader reader(link.ring(), link.tail());
  std::vector<std::uint8_t> record;
  for (bool gone = false;;) {
    RingReader::Result result;
    std::uint64_t newest = 0;
    bool taken = false;
    while ((result = reader.next(record)) == RingReader::Result::kRecord) {
      if (!file.cycle(record.data(), record.size())) {
        error = file.error();
        return false;
      }
      std::memcpy(&newest, record.data() + offsetof(berm_journal_cycle, cycle), sizeof newest);
      taken = true;
    }
    if (taken && pace >= 0) tell_pace(pace, newest);
    if (result == RingReader::Result::kBroken) {
      error = "the kernel's ring is damaged";
      return false;
    }
    if (gone) break;
    gone = link.kernel_gone(kPollMs);  // and then once more: what was written before the end
  }
  if (!file.end(reader.offered())) error = file.error();
  return error.empty();
}

}  // namespace

int main(int argc, char** argv) {
  berm::config::watch_standard_output("berm_journal");
  Options options;
  if (const int status = read_options(argc, argv, options); status >= 0) return status;
  signal(SIGPIPE, SIG_IGN);
  signal(SIGINT, SIG_IGN);   // the journal ends with the kernel, or the kernel's last cycles would be missing
  signal(SIGTERM, SIG_IGN);
  KernelLink link;
  std::string error;
  if (!link.connect(options.socket, error)) return fail(error);
  const std::string part = options.out + kPart;
  const std::string shown = options.fd >= 0 ? name_of(options.fd) : part;
  if (options.fd < 0) options.fd = open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (options.fd < 0) return fail(part + ": " + std::strerror(errno));
  JournalFile file(options.fd);
  std::printf("{\"event\": \"connected\"}\n");
  std::fflush(stdout);
  if (!file.begin(link.ring().start)) return fail(shown + ": " + file.error());
  if (!follow(link, file, options.pace, error)) return fail(shown + ": " + error);
  if (close(options.fd) != 0) return fail(shown + ": " + std::strerror(errno));
  if (!options.out.empty() && std::rename(part.c_str(), options.out.c_str()) != 0) return fail(options.out + ": " + std::strerror(errno));
  std::printf("{\"cycles\": %llu, \"lost\": %llu, \"bytes\": %llu}\n", static_cast<unsigned long long>(file.cycles()),
              static_cast<unsigned long long>(file.lost()), static_cast<unsigned long long>(file.bytes()));
  return EXIT_SUCCESS;
}
