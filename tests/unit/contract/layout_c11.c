#include "layout_table.inc"

#if __STDC_VERSION__ != 201112L
#error "this source is the C11 one"
#endif

const layout_entry *layout_c11(size_t *count) {
  *count = sizeof kLayout / sizeof kLayout[0];
  return kLayout;
}
