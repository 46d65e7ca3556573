#include "layout_table.inc"

static_assert(__cplusplus == 201703L, "this source is the C++17 one");

extern "C" const layout_entry* layout_cxx17(size_t* count) {
  *count = sizeof kLayout / sizeof kLayout[0];
  return kLayout;
}
