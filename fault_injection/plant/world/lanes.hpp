// A function marked BERM_PLANT_LANES is compiled twice, and the loader takes what the processor has. Both do the same operations in the same order (no
// fused multiply-add), so that the results are the same bit for bit.
#pragma once

#if defined(__x86_64__) && defined(__linux__) && !defined(__SANITIZE_ADDRESS__)
#define BERM_PLANT_LANES __attribute__((target_clones("avx2", "default")))
#else
#define BERM_PLANT_LANES
#endif
