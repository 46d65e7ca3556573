/* Parameter check: the convex parts that cover the implements. Returns SK_RULE_NONE or the first rule broken. */
#ifndef SK_PARAMETER_PARTS_H
#define SK_PARAMETER_PARTS_H
#include "parameter_rules.h"
SK_BEGIN

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures codes: \result == SK_RULE_NONE || SK_RULE_PART_COUNT <= \result <= SK_RULE_PART_EVERY_LINK;
  @ ensures whole: \result == SK_RULE_NONE <==> sk_parts_ok(p);
  @ ensures why_part_count: \result == SK_RULE_PART_COUNT ==> !sk_rule_part_count(p);
  @ ensures why_part_link: \result == SK_RULE_PART_LINK ==> !sk_rule_part_link(p);
  @ ensures why_part_width: \result == SK_RULE_PART_WIDTH ==> !sk_rule_part_width(p);
  @ ensures why_part_vertex_count: \result == SK_RULE_PART_VERTEX_COUNT ==> !sk_rule_part_vertex_count(p);
  @ ensures why_part_vertex_range: \result == SK_RULE_PART_VERTEX_RANGE ==> !sk_rule_part_vertex_range(p);
  @ ensures why_part_convex: \result == SK_RULE_PART_CONVEX ==> !sk_rule_part_convex(p);
  @ ensures why_part_every_link: \result == SK_RULE_PART_EVERY_LINK ==> !sk_rule_part_every_link(p);
  @*/
int32_t sk_check_parts(const berm_parameters *p);

SK_END
#endif
