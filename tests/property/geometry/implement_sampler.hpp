// Random points of the implements at random joint positions, with forward kinematics of the tests' own (complex numbers).
#ifndef BERM_TESTS_GEOMETRY_IMPLEMENT_SAMPLER_HPP
#define BERM_TESTS_GEOMETRY_IMPLEMENT_SAMPLER_HPP

#include <complex>

#include "machine_profile.hpp"

namespace berm::kernel::test {

struct ImplementPoint {
  int part;
  double angle[4];  // rad
  double x, y, z;   // base frame, mm
};

class ImplementSampler {
public:
  ImplementSampler(const berm_parameters& parameters, const sk_reach_box& box) : p_(parameters), box_(box) {}

  // Extremes are where coverage fails first: half the draws sit on the ends of the intervals and the corners of the parts.
  ImplementPoint draw(std::mt19937_64& random) const {
    ImplementPoint out{};
    for (int j = 0; j < 4; ++j) {
      const uint64_t kind = random() % 6;
      const double low = box_.low_urad[j] * 1e-6, high = box_.high_urad[j] * 1e-6;
      out.angle[j] = kind == 0 ? low : kind == 1 ? high : uniform(random, low, high);
    }
    out.part = static_cast<int>(random() % static_cast<uint64_t>(p_.parts));
    const berm_part& part = p_.part[out.part];
    std::complex<double> v;
    const auto corner = [&](uint64_t i) {
      const int32_t* c = part.vertex_mm[i % static_cast<uint64_t>(part.vertices)];
      return std::complex<double>(c[0], c[1]);
    };
    const uint64_t first = random();
    const uint64_t where = random() % 4;
    if (where < 2) {
      v = corner(first);
    } else { // on an edge or inside a triangle of corners
      const double s = uniform(random, 0, 1), t = where == 2 ? 0.0 : uniform(random, 0, 1 - s);
      v = (1 - s - t) * corner(first) + s * corner(first + 1) + t * corner(random());
    }
    const uint64_t side = random() % 4;
    const double w = part.half_width_mm;
    const double y = side == 0 ? w : side == 1 ? -w : uniform(random, -w, w);

    using C = std::complex<double>;
    C at(p_.boom_pin_x_mm, p_.boom_pin_z_mm);
    double elevation = out.angle[1];
    if (part.link >= 2) {
      at += std::polar(static_cast<double>(p_.boom_length_mm), elevation);
      elevation += out.angle[2];
    }
    if (part.link >= 3) {
      at += std::polar(static_cast<double>(p_.stick_length_mm), elevation);
      elevation += out.angle[3];
    }
    at += v * std::polar(1.0, elevation);
    const C ground = C(at.real(), y) * std::polar(1.0, out.angle[0]);
    out.x = ground.real();
    out.y = ground.imag();
    out.z = at.imag();
    return out;
  }

private:
  const berm_parameters& p_;
  const sk_reach_box& box_;
};

} // namespace berm::kernel::test
#endif
