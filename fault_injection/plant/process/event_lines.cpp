#include "plant/process/event_lines.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace berm::plant {

namespace {

void line(const std::string& text) {
  std::fputs((text + "\n").c_str(), stdout);
  std::fflush(stdout);
}

std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

}  // namespace

void EventLines::time(double t) const { line(fmt::format(R"({{"event":"time","t":{:.2f}}})", t)); }

void EventLines::truck(const char* event, double t, int truck, double load_kg) const {
  line(fmt::format(R"({{"event":"{}","t":{:.2f},"truck":{},"load_kg":{:.1f}}})", event, t, truck, load_kg));
}

void EventLines::contact(double t, const std::string& what) const {
  line(fmt::format(R"({{"event":"contact","t":{:.2f},"what":{}}})", t, quoted(what)));
}

void EventLines::peer(double t, const char* who, const char* state) const {
  line(fmt::format(R"({{"event":"peer","t":{:.2f},"who":"{}","state":"{}"}})", t, who, state));
}

void EventLines::bench_move(double t, double distance_m, double x_m) const {
  line(fmt::format(R"({{"event":"bench_move","t":{:.2f},"distance_m":{:.2f},"x_m":{:.2f}}})", t, distance_m, x_m));
}

void EventLines::press(double t, const char* keys, int stop_reason) const {
  line(fmt::format(R"({{"event":"press","t":{:.2f},"keys":"{}","stop_reason":{}}})", t, keys, stop_reason));
}

void EventLines::hand_lift(double t) const { line(fmt::format(R"({{"event":"hand_lift","t":{:.2f}}})", t)); }

void EventLines::finished(double t, const std::string& reason) const {
  line(fmt::format(R"({{"event":"finished","t":{:.2f},"reason":{}}})", t, quoted(reason)));
}

}  // namespace berm::plant
