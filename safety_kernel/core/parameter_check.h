/* Parameter check: whether a parameter block may be used. */
#ifndef SK_PARAMETER_CHECK_H
#define SK_PARAMETER_CHECK_H
#include "sk_common.h"
#include "config/parameter_block.h"
SK_BEGIN

/* 0 when every field is in its range and every braking table is monotone in speed and reach; else the ordinal of the first rule broken (1...), for
 * sk_parameter_rule_text() in io. The CRC is checked by the loader over the file's bytes with sk_crc32. */
int32_t sk_parameters_check(const berm_parameters *p);

SK_END
#endif
