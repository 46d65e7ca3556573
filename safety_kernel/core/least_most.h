/* The least and the most of two. For the files of the core only. */
#ifndef SK_LEAST_MOST_H
#define SK_LEAST_MOST_H
#include "sk_common.h"

/*@ logic integer sk_least(integer a, integer b) = a <= b ? a : b;
  @ logic integer sk_most(integer a, integer b) = a >= b ? a : b;
  @*/

/*@ assigns \nothing;
  @ ensures \result == sk_least(a, b);
  @*/
static inline int64_t sk_least_of(int64_t a, int64_t b)
{
  return a <= b ? a : b;
}

/*@ assigns \nothing;
  @ ensures \result == sk_most(a, b);
  @*/
static inline int64_t sk_most_of(int64_t a, int64_t b)
{
  return a >= b ? a : b;
}

#endif
