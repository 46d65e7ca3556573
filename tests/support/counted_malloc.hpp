// Counts every allocation of the process, libraries' included: malloc itself is replaced. For the one source file of a program of its own.
#pragma once

#include <cstddef>

#if defined(__SANITIZE_ADDRESS__)
#define BERM_COUNTS_MALLOC 0  // the sanitizer has replaced malloc already
#else
#define BERM_COUNTS_MALLOC 1
#endif

namespace {
long allocations = 0;
}

#if BERM_COUNTS_MALLOC
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* malloc(std::size_t n) {
  ++allocations;
  return __libc_malloc(n);
}
void* calloc(std::size_t n, std::size_t m) {
  ++allocations;
  return __libc_calloc(n, m);
}
void* realloc(void* p, std::size_t n) {
  ++allocations;
  return __libc_realloc(p, n);
}
}
#endif
