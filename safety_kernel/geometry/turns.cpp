#include "geometry/turns.hpp"

#include "geometry/lanes.hpp"

namespace berm::kernel {
namespace {

constexpr double quarter_turn = 1.5707963267948966;
constexpr double shift = 6755399441055744.0; // 1.5 * 2^52: adding it rounds to the nearest integer, which then stands in the last bits

} // namespace

BERM_LANES_CLONES void turns(const double* angle, int count, float* cosine, float* sine) noexcept {
  for (int i = 0; i < count; i += 4) {
    const FourDouble a = {angle[i], angle[i + 1], angle[i + 2], angle[i + 3]};
    const FourDouble shifted = a * (1.0 / quarter_turn) + shift, quarters = shifted - shift;
    FourLong bits;
    std::memcpy(&bits, &shifted, sizeof bits);
    const FourInt q = __builtin_convertvector(bits & 3, FourInt);
    // Within an eighth of a turn; the coefficients are those of Cephes' sinf and cosf.
    const Four r = __builtin_convertvector(a - quarters * quarter_turn, Four), rr = r * r;
    const Four s = r + r * rr * (four(-1.6666654611e-1F) + rr * (four(8.3321608736e-3F) + rr * four(-1.9515295891e-4F)));
    const Four c = four(1.0F) - four(0.5F) * rr + rr * rr * (four(4.166664568298827e-2F) + rr * (four(-1.388731625493765e-3F) + rr * four(2.443315711809948e-5F)));
    const FourInt odd = (q & 1) != 0, cosine_negative = ((q + 1) & 2) != 0, sine_negative = (q & 2) != 0;
    const Four plain_c = odd ? s : c, plain_s = odd ? c : s;
    store4(cosine + i, cosine_negative ? -plain_c : plain_c);
    store4(sine + i, sine_negative ? -plain_s : plain_s);
  }
}

} // namespace berm::kernel
