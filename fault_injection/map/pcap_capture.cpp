#include "map/pcap_capture.hpp"

#include <fmt/format.h>
#include <pcap/pcap.h>

#include <memory>
#include <stdexcept>

namespace berm::run {

namespace {

std::uint16_t big16(const std::uint8_t* p) { return static_cast<std::uint16_t>(p[0] << 8 | p[1]); }

// Bytes of the link header before the IPv4 header; -1 when the frame carries no IPv4.
int link_header(int link_type, const std::uint8_t* p, std::size_t n) {
  switch (link_type) {
    case DLT_EN10MB: {
      std::size_t at = 12;
      while (n >= at + 4 && big16(p + at) == 0x8100) at += 4;  // VLAN tags
      return n >= at + 2 && big16(p + at) == 0x0800 ? static_cast<int>(at + 2) : -1;
    }
    case DLT_LINUX_SLL: return n >= 16 && big16(p + 14) == 0x0800 ? 16 : -1;
    case DLT_RAW: return 0;
    default: return -1;
  }
}

bool udp_payload(int link_type, const std::uint8_t* p, std::size_t n, CapturedDatagram& out) {
  const int link = link_header(link_type, p, n);
  if (link < 0) return false;
  p += link;
  n -= static_cast<std::size_t>(link);
  if (n < 20 || p[0] >> 4 != 4) return false;
  const std::size_t header = static_cast<std::size_t>(p[0] & 0x0F) * 4;
  const std::size_t total = big16(p + 2);
  constexpr std::uint16_t kFragment = 0x3FFF;  // more fragments, or an offset
  if (header < 20 || total > n || total < header + 8 || p[9] != 17 || (big16(p + 6) & kFragment) != 0) return false;
  const std::uint8_t* udp = p + header;
  const std::size_t length = big16(udp + 4);
  if (length < 8 || header + length > total) return false;
  out.destination_port = big16(udp + 2);
  out.payload.assign(udp + 8, udp + length);
  return true;
}

}  // namespace

std::vector<CapturedDatagram> read_capture(const std::string& path) {
  char error[PCAP_ERRBUF_SIZE] = "";
  const std::unique_ptr<pcap_t, decltype(&pcap_close)> file(pcap_open_offline(path.c_str(), error), &pcap_close);
  if (!file) {
    const std::string reason = error;
    throw std::runtime_error(reason.starts_with(path) ? reason : fmt::format("{}: not a capture: {}", path, reason));
  }
  const int link_type = pcap_datalink(file.get());
  if (link_type != DLT_EN10MB && link_type != DLT_LINUX_SLL && link_type != DLT_RAW)
    throw std::runtime_error(fmt::format("{}: link layer {} is none of Ethernet, raw IP, Linux cooked", path, link_type));
  std::vector<CapturedDatagram> datagrams;
  pcap_pkthdr* header = nullptr;
  const std::uint8_t* bytes = nullptr;
  for (std::size_t number = 1;; ++number) {
    const int result = pcap_next_ex(file.get(), &header, &bytes);
    if (result == PCAP_ERROR_BREAK) return datagrams;
    if (result != 1) throw std::runtime_error(fmt::format("{}: packet {}: {}", path, number, pcap_geterr(file.get())));
    if (header->caplen < header->len) throw std::runtime_error(fmt::format("{}: packet {}: only {} of {} bytes were captured", path, number, header->caplen, header->len));
    CapturedDatagram datagram{number, static_cast<double>(header->ts.tv_sec) + static_cast<double>(header->ts.tv_usec) * 1e-6, 0, {}};
    if (udp_payload(link_type, bytes, header->caplen, datagram)) datagrams.push_back(std::move(datagram));
  }
}

}  // namespace berm::run
