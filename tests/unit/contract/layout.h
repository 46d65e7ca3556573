/* Offsets and sizes as one language sees them. */
#ifndef BERM_TEST_LAYOUT_H
#define BERM_TEST_LAYOUT_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A field; or, with an empty field name, the structure's size in offset, after all its fields. */
typedef struct layout_entry {
  const char *type;
  const char *field;
  size_t offset;
  size_t size;
} layout_entry;

const layout_entry *layout_c11(size_t *count);
const layout_entry *layout_cxx17(size_t *count);

#ifdef __cplusplus
}
#endif
#endif
