#include "base_slip.h"

void sk_slip_begin(sk_slip_state *s)
{
  s->next = 0;
  s->open = false;
  s->leans = false;
  s->favoured = false;
  s->trust = 0;
  s->rounds = 0;
  s->confirmed = false;
  s->learns = true;
  s->slipped = false;
}

/*@ requires 0 <= four <= 4611686018427387904 && SK_SLIP_LEAST_SQUARE <= square <= 2147483647;
  @ assigns \nothing;
  @ ensures \result == sk_slip_level(four, square) && 0 <= \result <= SK_SLIP_VOTE_MOST;
  @*/
static int32_t sk_slip_level_of(int64_t four, int64_t square)
{
  if (four >= 36 * square) { return 6; }
  if (four >= 25 * square) { return 5; }
  if (four >= 16 * square) { return 4; }
  if (four >= 9 * square) { return 3; }
  if (four >= 4 * square) { return 2; }
  return four >= square ? 1 : 0;
}

int32_t sk_slip_vote(int32_t net, int32_t square)
{
  int64_t product;
  int32_t level;
  if (square < SK_SLIP_LEAST_SQUARE || net < -SK_SLIP_SUM_MAX || net > SK_SLIP_SUM_MAX) { return 0; }
  product = (int64_t)net * net;
  /*@ assert 0 <= product <= 1152921504606846976; */
  level = sk_slip_level_of(4 * product, square);
  return net < 0 ? -level : level;
}

uint8_t sk_slip_weigh(int32_t votes, int32_t blocks)
{
  int32_t product;
  if (blocks < SK_SLIP_LEAST_BLOCKS || blocks > SK_SLIP_BLOCKS) { return SK_SLIP_OPEN; }
  if (votes < -SK_SLIP_VOTE_MOST * blocks || votes > SK_SLIP_VOTE_MOST * blocks) { return SK_SLIP_OPEN; }
  /*@ assert -432 <= votes <= 432; */
  /*@ assert 0 <= votes * votes <= 186624; */
  product = votes * votes;
  if (product >= 64 * blocks) { return votes < 0 ? SK_SLIP_EXCLUDED : SK_SLIP_FAVOURED; }
  return votes > 0 && product >= 4 * blocks ? SK_SLIP_LEANS : SK_SLIP_OPEN;
}

/*@ requires \valid(s) && sk_slip_valid(s);
  @ assigns s->next, s->open, s->leans, s->favoured, s->trust, s->rounds, s->confirmed, s->learns, s->slipped;
  @ ensures sk_slip_valid(s) && s->next == 0 && s->open == false && s->leans == false && s->favoured == false;
  @ ensures again: \old(s->favoured) == true && \old(s->trust) >= SK_SLIP_TRUST_LEAST ==> s->rounds == sk_slip_no_more(\old(s->rounds) + 1, SK_SLIP_ROUNDS);
  @ ensures ended: \old(s->favoured) == false || \old(s->trust) < SK_SLIP_TRUST_LEAST ==> s->rounds == 0;
  @ ensures confirmed: s->confirmed == true <==> \old(s->open) == false;
  @ ensures learns: s->learns == true <==> \old(s->leans) == false;
  @ ensures gained: s->confirmed == true ==> s->trust == sk_slip_no_more(\old(s->trust) + SK_SLIP_TRUST_GAIN, SK_SLIP_TRUST_MOST);
  @ ensures lost: s->confirmed == false ==> s->trust == sk_slip_less(\old(s->trust));
  @ ensures slipped: s->slipped == true <==> \old(s->slipped) == true || s->rounds >= SK_SLIP_ROUNDS;
  @*/
static void sk_slip_close(sk_slip_state *s)
{
  if (!s->favoured || s->trust < SK_SLIP_TRUST_LEAST) {
    s->rounds = 0;
  } else if (s->rounds < SK_SLIP_ROUNDS) {
    s->rounds = s->rounds + 1;
  }
  if (s->rounds >= SK_SLIP_ROUNDS) { s->slipped = true; }
  s->confirmed = !s->open;
  s->learns = !s->leans;
  if (s->open) {
    s->trust = s->trust > 0 ? s->trust - 1 : 0;
  } else {
    s->trust = s->trust < SK_SLIP_TRUST_MOST - SK_SLIP_TRUST_GAIN ? s->trust + SK_SLIP_TRUST_GAIN : SK_SLIP_TRUST_MOST;
  }
  s->next = 0;
  s->open = false;
  s->leans = false;
  s->favoured = false;
}

bool sk_slip_judge(sk_slip_state *s, int32_t votes, int32_t blocks)
{
  uint8_t weight = sk_slip_weigh(votes, blocks);
  if (weight != SK_SLIP_EXCLUDED) { s->open = true; }
  if (weight >= SK_SLIP_LEANS) { s->leans = true; }
  if (weight == SK_SLIP_FAVOURED) { s->favoured = true; }
  if (s->next == SK_SLIP_SHIFTS - 1) {
    sk_slip_close(s);
    return true;
  }
  s->next = s->next + 1;
  return false;
}
