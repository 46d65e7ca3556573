#include "forbidden_calls.hpp"

#include <dlfcn.h>
#include <pthread.h>
#include <semaphore.h>

#include <cstddef>
#include <cstdlib>
#include <typeinfo>

namespace {

berm::kernel::test::ForbiddenCalls calls;

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

namespace berm::kernel::test {

ForbiddenCalls forbidden_calls() { return calls; }

bool forbidden_calls_count() {
#if defined(__SANITIZE_ADDRESS__)
  return false;
#else
  return true;
#endif
}

}  // namespace berm::kernel::test

#if !defined(__SANITIZE_ADDRESS__)
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t n) {
  ++calls.allocations;
  return __libc_malloc(n);
}
void* calloc(std::size_t n, std::size_t m) {
  ++calls.allocations;
  return __libc_calloc(n, m);
}
void* realloc(void* p, std::size_t n) {
  ++calls.allocations;
  return __libc_realloc(p, n);
}
void* memalign(std::size_t alignment, std::size_t n) {
  ++calls.allocations;
  return __libc_memalign(alignment, n);
}
void* aligned_alloc(std::size_t alignment, std::size_t n) {
  ++calls.allocations;
  return __libc_memalign(alignment, n);
}
int posix_memalign(void** to, std::size_t alignment, std::size_t n) {
  ++calls.allocations;
  *to = __libc_memalign(alignment, n);
  return *to == nullptr ? 12 : 0;
}
void free(void* p) {
  if (p != nullptr) ++calls.allocations;
  __libc_free(p);
}

[[noreturn]] void __cxa_throw(void* object, std::type_info* type, void (*destroy)(void*)) {
  ++calls.throws;
  using Throw = void (*)(void*, std::type_info*, void (*)(void*));
  next<Throw>("__cxa_throw")(object, type, destroy);
  std::abort();
}

// The lookup is made once a function; what it locks by itself comes before the count is taken.
#define BERM_COUNTED(name, parameters, arguments)                          \
  int name parameters noexcept {                                           \
    static int(*const real) parameters = next<int(*) parameters>(#name);   \
    ++calls.locks;                                                         \
    return real arguments;                                                 \
  }
BERM_COUNTED(pthread_mutex_lock, (pthread_mutex_t * m), (m))
BERM_COUNTED(pthread_mutex_trylock, (pthread_mutex_t * m), (m))
BERM_COUNTED(pthread_rwlock_rdlock, (pthread_rwlock_t * l), (l))
BERM_COUNTED(pthread_rwlock_wrlock, (pthread_rwlock_t * l), (l))
BERM_COUNTED(pthread_spin_lock, (pthread_spinlock_t * l), (l))
#undef BERM_COUNTED
int pthread_cond_wait(pthread_cond_t* c, pthread_mutex_t* m) {
  ++calls.locks;
  return next<int (*)(pthread_cond_t*, pthread_mutex_t*)>("pthread_cond_wait")(c, m);
}
int sem_wait(sem_t* s) {
  ++calls.locks;
  return next<int (*)(sem_t*)>("sem_wait")(s);
}
}
#endif
