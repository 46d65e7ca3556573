// Small whole files of each format, and the real ones.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace berm::app::test {

inline std::string real_data(const std::string& file) {
  const char* folder = std::getenv("BERM_REAL_DATA");
  return std::string(folder != nullptr && *folder != '\0' ? folder : BERM_REAL_DATA) + "/" + file;
}

inline std::string pcd_header(const std::string& points, const std::string& data, const std::string& extra = {}) {
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z scanline time\nSIZE 4 4 4 4 8\nTYPE F F F U F\nCOUNT 1 1 1 1 1\nWIDTH " + points +
         "\nHEIGHT 1\n" + extra + "POINTS " + points + "\nDATA " + data + "\n";
}

inline void put16(std::string& out, unsigned v) { // little-endian
  out.push_back(static_cast<char>(v & 0xFF));
  out.push_back(static_cast<char>(v >> 8 & 0xFF));
}
inline void put32(std::string& out, std::uint32_t v) {
  put16(out, v & 0xFFFF);
  put16(out, v >> 16);
}
inline void put_big(std::string& out, std::uint32_t v, int bytes) {
  for (int i = bytes - 1; i >= 0; --i) out.push_back(static_cast<char>(v >> (8 * i) & 0xFF));
}

// A VLP-16 data packet; azimuths in 0.01 degrees rising by 40 a block (by 40 a pair when dual); every range of block b is steps(b) of 2 mm.
template <typename Steps>
std::string vlp16_packet(std::uint32_t clock_us, unsigned azimuth, bool dual, Steps steps) {
  std::string out;
  for (unsigned block = 0; block < 12; ++block) {
    put16(out, 0xEEFF);
    put16(out, (azimuth + 40 * (dual ? block / 2 : block)) % 36000);
    for (int shot = 0; shot < 32; ++shot) {
      put16(out, steps(block));
      out.push_back('\7');
    }
  }
  put32(out, clock_us);
  out.push_back(dual ? '\x39' : '\x37');
  out.push_back('\x22');
  return out;
}

// Ethernet, IPv4 and UDP around each payload, in a pcap of microseconds.
inline std::string pcap_of(const std::vector<std::string>& payloads) {
  std::string out;
  put32(out, 0xA1B2C3D4);
  put16(out, 2);
  put16(out, 4);
  put32(out, 0);
  put32(out, 0);
  put32(out, 65535);
  put32(out, 1);
  for (std::size_t i = 0; i < payloads.size(); ++i) {
    std::string frame(12, '\0');
    put_big(frame, 0x0800, 2);
    frame += "\x45";
    frame.push_back('\0');
    put_big(frame, static_cast<std::uint32_t>(28 + payloads[i].size()), 2);
    frame += std::string(4, '\0') + "\x40\x11" + std::string(10, '\0');
    put_big(frame, 2368, 2);
    put_big(frame, 2368, 2);
    put_big(frame, static_cast<std::uint32_t>(8 + payloads[i].size()), 2);
    put_big(frame, 0, 2);
    frame += payloads[i];
    put32(out, static_cast<std::uint32_t>(i));
    put32(out, 0);
    put32(out, static_cast<std::uint32_t>(frame.size()));
    put32(out, static_cast<std::uint32_t>(frame.size()));
    out += frame;
  }
  return out;
}

inline std::string cola_b(const std::string& body) {
  std::string out = "\x02\x02\x02\x02";
  put_big(out, static_cast<std::uint32_t>(body.size()), 4);
  char sum = 0;
  for (const char c : body) sum = static_cast<char>(sum ^ c);
  return out + body + sum;
}

struct LmsChannelSample {
  std::string content;
  std::uint32_t scale_bits;  // of a float
  std::int32_t start;        // 1/10000 degree
  unsigned step;
  std::vector<unsigned> raw;
};

inline std::string lmd_scandata(std::uint32_t startup_us, const std::vector<LmsChannelSample>& wide, const std::vector<LmsChannelSample>& narrow) {
  std::string out = "sSN LMDscandata ";
  out += std::string(12, '\1');
  put_big(out, 7, 2);  // scan counter
  put_big(out, startup_us, 4);
  out += std::string(10, '\0');
  put_big(out, 5000, 4);
  put_big(out, 360, 4);
  put_big(out, 1, 2);  // one encoder
  out += std::string(6, '\5');
  for (const auto* list : {&wide, &narrow}) {
    put_big(out, static_cast<std::uint32_t>(list->size()), 2);
    for (const LmsChannelSample& c : *list) {
      out += c.content;
      put_big(out, c.scale_bits, 4);
      put_big(out, 0, 4);
      put_big(out, static_cast<std::uint32_t>(c.start), 4);
      put_big(out, c.step, 2);
      put_big(out, static_cast<std::uint32_t>(c.raw.size()), 2);
      for (const unsigned v : c.raw) put_big(out, v, list == &wide ? 2 : 1);
    }
  }
  put_big(out, 0, 2);
  put_big(out, 0, 2);
  put_big(out, 0, 2);
  put_big(out, 1, 2);
  put_big(out, 2021, 2);
  out += std::string("\3\2", 2);
  out += std::string("\1\2\3", 3);  // 01:02:03
  put_big(out, 500000, 4);
  put_big(out, 0, 2);
  return out;
}

inline std::string tshark_json(const std::vector<std::string>& payloads) {
  std::string out = "[";
  for (const std::string& payload : payloads) {
    if (out.size() > 1) out += ",";
    out += R"({"_source":{"layers":{"tcp":{"tcp.payload":")";
    for (std::size_t i = 0; i < payload.size(); ++i) {
      static constexpr char kDigits[] = "0123456789abcdef";
      if (i > 0) out += ':';
      out += kDigits[static_cast<unsigned char>(payload[i]) >> 4];
      out += kDigits[payload[i] & 15];
    }
    out += "\"}}}}";
  }
  return out + "]";
}

}  // namespace berm::app::test
