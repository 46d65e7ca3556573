// Cosine and sine of several angles at once.
#ifndef BERM_KERNEL_GEOMETRY_TURNS_HPP
#define BERM_KERNEL_GEOMETRY_TURNS_HPP

namespace berm::kernel {

// Of count angles (rad, magnitude below 1e5), each good to 2e-7. All three arrays reach to the next multiple of four, and those places are read and written.
void turns(const double* angle, int count, float* cosine, float* sine) noexcept;

} // namespace berm::kernel
#endif
