/* Stop logic: INIT, STANDBY, RUN, STOPPING, STOPPED, FAULT. What latches, what resumes by itself, what needs the operator. */
#ifndef SK_STOP_LOGIC_H
#define SK_STOP_LOGIC_H
#include "sk_common.h"
SK_BEGIN

/* far-apart codes: no single, double or triple bit flip turns one into another */
#define SK_STATE_INIT     0x1E2Du
#define SK_STATE_STANDBY  0x5A3Cu
#define SK_STATE_RUN      0xA5C3u
#define SK_STATE_STOPPING 0xC35Au
#define SK_STATE_STOPPED  0x3CA5u
#define SK_STATE_FAULT    0x6996u

/* Inputs of one cycle. reason codes are BERM_STOP_* of the contract. */
typedef struct sk_stop_input {
  int64_t now_us;
  uint8_t fault_reason;      /* BERM_STOP_* of a fault seen in this cycle, or 0: latches FAULT */
  bool fault_category_0;     /* that fault removes power at once */
  uint8_t latch_reason;      /* operator, e-stop, app silent: latches STOPPED, or 0 */
  bool latch_category_0;
  uint8_t hold_reason;       /* collision predicted, unknown, stale, floor, range, request hold: stops, resumes by itself, or 0 */
  bool inputs_ready;         /* parameters in force, first frames of machine and operator seen, scanners alive */
  bool standstill;
  bool operator_run;         /* run switch */
  bool operator_reset;       /* reset key, level */
} sk_stop_input;

typedef struct sk_stop_state {
  uint16_t code;
  uint8_t reason;            /* in force; 0 in RUN */
  uint8_t category;          /* 0, 1; 255 none */
  bool latched;
  bool reset_seen_released;  /* a reset counts only after the key was seen released */
  int64_t since_us;          /* when this state was entered */
} sk_stop_state;

typedef struct sk_stop_output {
  bool motion_enabled;       /* commands of the request may be sent */
  bool heartbeat_enable;     /* the machine keeps pilot pressure */
} sk_stop_output;

void sk_stop_init(sk_stop_state *s);
/* Total: a state code that is none of the six is read as FAULT (BERM_STOP_INTERNAL). */
void sk_stop_step(sk_stop_state *s, const sk_stop_input *in, sk_stop_output *out);

SK_END
#endif
