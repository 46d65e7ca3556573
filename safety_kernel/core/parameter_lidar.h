/* Parameter check: the lidars on the upper body. Returns SK_RULE_NONE or the first rule broken. */
#ifndef SK_PARAMETER_LIDAR_H
#define SK_PARAMETER_LIDAR_H
#include "parameter_rules.h"
SK_BEGIN

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures codes: \result == SK_RULE_NONE || SK_RULE_LIDAR_COUNT <= \result <= SK_RULE_LIDAR_ANGLES;
  @ ensures whole: \result == SK_RULE_NONE <==> sk_lidars_ok(p);
  @ ensures why_lidar_count: \result == SK_RULE_LIDAR_COUNT ==> !sk_rule_lidar_count(p);
  @ ensures why_lidar_position: \result == SK_RULE_LIDAR_POSITION ==> !sk_rule_lidar_position(p);
  @ ensures why_lidar_angles: \result == SK_RULE_LIDAR_ANGLES ==> !sk_rule_lidar_angles(p);
  @*/
int32_t sk_check_lidars(const berm_parameters *p);

SK_END
#endif
