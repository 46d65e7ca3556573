/* What every file of the core shares. The core is the common subset of C11 and C++17: integers only, no allocation, no recursion,
 * no function pointers, no unions, no pointer casts. The files that ship are the files that Frama-C/WP reads. */
#ifndef SK_COMMON_H
#define SK_COMMON_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
#define SK_BEGIN extern "C" {
#define SK_END }
#else
#define SK_BEGIN
#define SK_END
#endif

/* Compiled twice, the loader takes what the processor has: the same integers either way. Nothing to the proof's reading. */
#if defined(__cplusplus) && defined(__x86_64__) && defined(__linux__) && !defined(__SANITIZE_ADDRESS__)
#define SK_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define SK_CLONES
#endif

/* Kept out of line, so that what is asked of every cell stays in line. Nothing to the proof's reading. */
#if defined(__cplusplus) && defined(__GNUC__)
#define SK_SELDOM __attribute__((noinline, cold))
#else
#define SK_SELDOM
#endif

#define SK_JOINTS 4
#ifndef SK_MAP_CELLS
#define SK_MAP_CELLS 104 /* along one side */
#endif
#ifndef SK_CELL_MM
#define SK_CELL_MM 300
#endif
#define SK_MAP_ORIGIN_MM (-(SK_MAP_CELLS * SK_CELL_MM) / 2) /* x and y of the low corner */
#define SK_COORD_MAX_MM 32000   /* every coordinate the core takes lies within +- this */
#define SK_HEIGHT_MAX_MM 20000  /* heights are clamped to +- this by the map */

#endif
