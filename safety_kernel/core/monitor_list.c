#include "monitor_list.h"

void sk_list_clear(sk_monitor *m)
{
  m->modified = 0;
  m->overflowed = false;
}

/*@ requires \valid_read(m) && sk_in_map(iy, ix) && sk_list_ok(m);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_listed(m, iy, ix);
  @*/
static bool sk_list_has(const sk_monitor *m, int32_t iy, int32_t ix)
{
  uint32_t k = m->place[iy][ix];
  return k < m->modified && m->modified_iy[k] == (uint64_t)iy && m->modified_ix[k] == (uint64_t)ix;
}

void sk_list_add(sk_monitor *m, int32_t iy, int32_t ix)
{
  if (sk_list_has(m, iy, ix)) { return; }
  /*@ assert new: \forall integer k; 0 <= k < m->modified ==> !(m->modified_iy[k] == iy && m->modified_ix[k] == ix); */
  if (m->modified >= SK_MODIFIED_MOST) {
    m->overflowed = true;
    return;
  }
  m->modified_iy[m->modified] = (uint64_t)iy;
  m->modified_ix[m->modified] = (uint64_t)ix;
  m->place[iy][ix] = (uint32_t)m->modified;
  m->modified = m->modified + 1;
}

void sk_list_remove(sk_monitor *m, int64_t k)
{
  int64_t last = m->modified - 1;
  /*@ assert entry: sk_entry_ok(m, last); */
  uint64_t iy = m->modified_iy[last];
  uint64_t ix = m->modified_ix[last];
  m->modified_iy[k] = iy;
  m->modified_ix[k] = ix;
  m->place[iy][ix] = (uint32_t)k;
  m->modified = last;
}
