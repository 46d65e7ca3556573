#include "points/pcap.hpp"

#include <fmt/format.h>
#include <pcap/pcap.h>

#include <cstdio>
#include <memory>

#include "points/file_bytes.hpp"
#include "points/vlp16_packet.hpp"

namespace berm::app {
namespace {

constexpr std::size_t kPackets = 20'000'000;

unsigned big16(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned>(static_cast<unsigned char>(bytes[at])) << 8 | static_cast<unsigned char>(bytes[at + 1]);
}

// The IPv4 packet in a frame; empty when there is none.
std::string_view ip_packet(int link_type, std::string_view frame) {
  if (link_type == DLT_RAW) return frame;
  std::size_t at = link_type == DLT_EN10MB ? 12 : 14;
  while (link_type == DLT_EN10MB && frame.size() >= at + 4 && big16(frame, at) == 0x8100) at += 4;  // VLAN tags
  return frame.size() >= at + 2 && big16(frame, at) == 0x0800 ? frame.substr(at + 2) : std::string_view{};
}

// Empty when the packet is no whole UDP datagram.
std::string_view udp_payload(std::string_view ip) {
  if (ip.size() < 20 || static_cast<unsigned char>(ip[0]) >> 4 != 4 || ip[9] != 17) return {};
  const std::size_t header = (static_cast<unsigned char>(ip[0]) & 0x0FU) * 4U, total = big16(ip, 2);
  constexpr unsigned kFragment = 0x3FFF;  // more fragments, or an offset
  if (header < 20 || total > ip.size() || total < header + 8 || (big16(ip, 6) & kFragment) != 0) return {};
  const std::size_t length = big16(ip, header + 4);
  if (length < 8 || header + length > total) return {};
  return ip.substr(header + 8, length - 8);
}

class Columns {
public:
  Columns(PointCloud& cloud) : cloud_(cloud) {}

  void add(const Vlp16Packet& packet, std::size_t number) {
    if (packets_ > 0 && packet.clock_s < clock_s_) {
      if (clock_s_ - packet.clock_s < kVlp16HourS / 2) throw PointFileError(fmt::format("{}: packet {}: clock: runs backwards", cloud_.file, number));
      hour_s_ += kVlp16HourS;
    }
    clock_s_ = packet.clock_s;
    ++packets_;
    for (const Vlp16Firing& firing : packet.firings) {
      for (int i = 0; i < firing.returns; ++i) {
        const auto& p = firing.point[static_cast<std::size_t>(i)];
        cloud_.points.push_back({p.x, p.y, p.z, scanline_, hour_s_ + clock_s_ + firing.since_packet_s});
      }
      ++scanline_;
    }
  }
  std::size_t packets() const { return packets_; }

private:
  PointCloud& cloud_;
  std::size_t packets_ = 0;
  std::uint32_t scanline_ = 0;
  double clock_s_ = 0.0, hour_s_ = 0.0;
};

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

PointCloud parse_pcap(std::string_view bytes, const std::string& name) {
  PointCloud cloud;
  cloud.file = name;
  cloud.format = "pcap";
  if (bytes.empty()) throw PointFileError(fmt::format("{}: size: the file is empty", name));
  std::string copy(bytes);  // fmemopen wants memory that it might write
  std::unique_ptr<std::FILE, CloseFile> memory(fmemopen(copy.data(), copy.size(), "r"));
  if (!memory) throw PointFileError(fmt::format("{}: cannot be read from memory", name));
  char error[PCAP_ERRBUF_SIZE] = "";
  const std::unique_ptr<pcap_t, decltype(&pcap_close)> capture(pcap_fopen_offline(memory.get(), error), &pcap_close);
  if (!capture) throw PointFileError(fmt::format("{}: header: not a capture: {}", name, error));
  memory.release();  // now the capture's
  const int link_type = pcap_datalink(capture.get());
  if (link_type != DLT_EN10MB && link_type != DLT_LINUX_SLL && link_type != DLT_RAW)
    throw PointFileError(fmt::format("{}: link layer: {} is none of Ethernet, raw IP, Linux cooked", name, link_type));
  Columns columns(cloud);
  Vlp16Packet packet;
  pcap_pkthdr* header = nullptr;
  const unsigned char* data = nullptr;
  for (std::size_t number = 1; number <= kPackets; ++number) {
    const int result = pcap_next_ex(capture.get(), &header, &data);
    if (result == PCAP_ERROR_BREAK) {
      if (columns.packets() == 0) throw PointFileError(fmt::format("{}: packets: none of {} is a VLP-16 packet of {} bytes", name, number - 1, kVlp16Bytes));
      return cloud;
    }
    if (result != 1) throw PointFileError(fmt::format("{}: packet {}: {}", name, number, pcap_geterr(capture.get())));
    if (header->caplen < header->len)
      throw PointFileError(fmt::format("{}: packet {}: length: only {} of {} bytes were captured", name, number, header->caplen, header->len));
    const auto payload = udp_payload(ip_packet(link_type, {reinterpret_cast<const char*>(data), header->caplen}));
    if (payload.size() != kVlp16Bytes) continue;
    const Vlp16Fault fault = decode_vlp16(payload, packet);
    if (fault != Vlp16Fault::kNone) throw PointFileError(fmt::format("{}: packet {}: {}", name, number, vlp16_fault_text(fault)));
    columns.add(packet, number);
  }
  throw PointFileError(fmt::format("{}: packets: more than {}", name, kPackets));
}

PointCloud read_pcap(const std::string& path) { return parse_pcap(read_file_bytes(path), path); }

}  // namespace berm::app
