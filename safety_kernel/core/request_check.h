/* Request check: whether a motion request may be used at all. Works on a private copy of the bytes. */
#ifndef SK_REQUEST_CHECK_H
#define SK_REQUEST_CHECK_H
#include "sk_common.h"
#include "config/parameter_block.h"
SK_BEGIN

#define SK_REQUEST_BYTES 64

typedef struct sk_request {
  uint16_t phase;
  uint32_t flags;          /* BERM_REQUEST_FLAG_* */
  uint32_t sequence;
  int64_t stamp_us;
  int32_t joint_velocity_urad_s[4];
  int32_t pan_goal_urad[2];
  int32_t pan_rate_urad_s[2];
} sk_request;

typedef struct sk_request_state {
  bool primed;             /* a request has been accepted since the app connected */
  uint32_t last_sequence;
  int64_t last_accept_us;
} sk_request_state;

/* Returns BERM_REQUEST_* (contract header). The same sequence as last accepted is BERM_REQUEST_NONE. Anything but ACCEPTED leaves *state and *out as they were.
 * Sequence: 1..1000 ahead of the last, wrapping. Age: 0 <= now - stamp <= request_age_us. Ranges: velocities within velocity_max, pan goals within the pan limits,
 * rates 0..pan_rate_max; reserved fields zero; phase below BERM_PHASE_COUNT. */
int32_t sk_request_check(sk_request_state *state, const uint8_t raw[SK_REQUEST_BYTES], const berm_parameters *p, int64_t now_us, sk_request *out);

SK_END
#endif
