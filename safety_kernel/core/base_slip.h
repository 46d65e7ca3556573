/* Slip of the base: whether the terrain that the scanners see now lies where it lay when the map was begun, or elsewhere by one and the same shift.
 * The geometry scores every return at the place where it is seen and at each of SK_SLIP_SHIFTS others, summed over SK_SLIP_BLOCKS parts of the
 * surroundings; here it is decided what these sums mean. A block has one vote, however much it changed: a truck, a person or a heap of soil fills
 * a few blocks, a slip moves all. */
#ifndef SK_BASE_SLIP_H
#define SK_BASE_SLIP_H
#include "sk_common.h"
SK_BEGIN

#define SK_SLIP_SHIFTS 282        /* 17 x 17 cells of shift but the inner 3 x 3, and up and down */
#define SK_SLIP_BLOCKS 72         /* 24 bearings, 3 distances */
#define SK_SLIP_LEAST_BLOCKS 8    /* with fewer, nothing is said */
#define SK_SLIP_LEAST_SQUARE 4096 /* of a block that says anything: a sixteenth of a return that agrees fully there and not at all here */
#define SK_SLIP_SUM_MAX 1073741824
#define SK_SLIP_VOTE_MOST 6       /* in half standard deviations */
#define SK_SLIP_ROUNDS 2          /* successive rounds that must favour a shift */
/* Only a terrain that lately excluded every shift, round after round, may show one: over ground without features any shift is as good as none. A
 * round that excludes all counts up, any other down. */
#define SK_SLIP_TRUST_GAIN 3
#define SK_SLIP_TRUST_LEAST 40
#define SK_SLIP_TRUST_MOST 240

enum { SK_SLIP_EXCLUDED = 0, SK_SLIP_OPEN = 1, SK_SLIP_LEANS = 2, SK_SLIP_FAVOURED = 3 };

typedef struct sk_slip_state {
  int32_t next;                     /* the shift to be judged; a round judges all of them in their order */
  bool open, leans, favoured;       /* in this round so far: a shift was not excluded, was leant to, was favoured */
  int32_t trust;                    /* that the terrain shows slips: 0 to SK_SLIP_TRUST_MOST */
  int32_t rounds;                   /* the newest successive rounds that favoured a shift, trusted, to SK_SLIP_ROUNDS at most */
  bool confirmed;                   /* the newest round excluded every shift */
  bool learns;                      /* no shift was leant to in the newest round: what is seen may be added to the reference */
  bool slipped;                     /* since the beginning */
} sk_slip_state;

/*@ // how many half standard deviations: 4 net^2 against square, in the steps 1, 4, 9, ...
  @ logic integer sk_slip_level(integer four, integer square) = four >= 36 * square ? 6 : (four >= 25 * square ? 5 : (four >= 16 * square ? 4 :
  @   (four >= 9 * square ? 3 : (four >= 4 * square ? 2 : (four >= square ? 1 : 0)))));
  @ predicate sk_slip_counts(integer net, integer square) = square >= SK_SLIP_LEAST_SQUARE && -SK_SLIP_SUM_MAX <= net <= SK_SLIP_SUM_MAX;
  @ // the votes' sum is in half standard deviations of one block: 64 times the blocks is the square of four deviations of the sum
  @ logic integer sk_slip_polled(integer votes, integer blocks) =
  @   votes < 0 ? (votes * votes >= 64 * blocks ? SK_SLIP_EXCLUDED : SK_SLIP_OPEN) :
  @   (votes * votes >= 64 * blocks ? SK_SLIP_FAVOURED : (votes * votes >= 4 * blocks ? SK_SLIP_LEANS : SK_SLIP_OPEN));
  @ logic integer sk_slip_weight(integer votes, integer blocks) =
  @   blocks < SK_SLIP_LEAST_BLOCKS ? SK_SLIP_OPEN : (blocks > SK_SLIP_BLOCKS ? SK_SLIP_OPEN :
  @   (votes < -SK_SLIP_VOTE_MOST * blocks ? SK_SLIP_OPEN : (votes > SK_SLIP_VOTE_MOST * blocks ? SK_SLIP_OPEN : sk_slip_polled(votes, blocks))));
  @ predicate sk_slip_valid{L}(sk_slip_state *s) = 0 <= \at(s->next, L) < SK_SLIP_SHIFTS && 0 <= \at(s->rounds, L) <= SK_SLIP_ROUNDS &&
  @   0 <= \at(s->trust, L) <= SK_SLIP_TRUST_MOST;
  @ logic integer sk_slip_no_more(integer count, integer most) = count > most ? most : count;
  @ logic integer sk_slip_less(integer trust) = trust > 0 ? trust - 1 : 0;
  @*/

/* Nothing known, no trust; what is seen is learned. */
/*@ requires \valid(s);
  @ assigns *s;
  @ ensures sk_slip_valid(s) && s->next == 0 && s->rounds == 0 && s->trust == 0;
  @ ensures s->open == false && s->leans == false && s->favoured == false && s->confirmed == false && s->learns == true && s->slipped == false;
  @*/
void sk_slip_begin(sk_slip_state *s);

/* A block's vote, positive for the shift. net: the sum, over its returns, of how much better each agrees with the reference there than here;
 * square: the sum of its squares. 0 where there is too little to say. */
/*@ assigns \nothing;
  @ ensures range: -SK_SLIP_VOTE_MOST <= \result <= SK_SLIP_VOTE_MOST;
  @ ensures none: !sk_slip_counts(net, square) ==> \result == 0;
  @ ensures there: sk_slip_counts(net, square) && net >= 0 ==> \result == sk_slip_level(4 * (net * net), square);
  @ ensures here: sk_slip_counts(net, square) && net < 0 ==> \result == -sk_slip_level(4 * (net * net), square);
  @*/
int32_t sk_slip_vote(int32_t net, int32_t square);

/* SK_SLIP_...: what the votes of so many blocks say of a shift. */
/*@ assigns \nothing;
  @ ensures \result == sk_slip_weight(votes, blocks);
  @*/
uint8_t sk_slip_weigh(int32_t votes, int32_t blocks);

/* Judges the next shift by its votes. True when it was the last of its round. Nothing but sk_slip_begin takes `slipped` back. */
/*@ requires \valid(s) && sk_slip_valid(s);
  @ assigns *s;
  @ ensures valid: sk_slip_valid(s);
  @ ensures last: \result == true <==> \old(s->next) == SK_SLIP_SHIFTS - 1;
  @ ensures next: s->next == (\old(s->next) == SK_SLIP_SHIFTS - 1 ? 0 : \old(s->next) + 1);
  @ ensures open: \result == false ==> (s->open == true <==> \old(s->open) == true || sk_slip_weight(votes, blocks) != SK_SLIP_EXCLUDED);
  @ ensures leans: \result == false ==> (s->leans == true <==> \old(s->leans) == true || sk_slip_weight(votes, blocks) >= SK_SLIP_LEANS);
  @ ensures favoured: \result == false ==> (s->favoured == true <==> \old(s->favoured) == true || sk_slip_weight(votes, blocks) == SK_SLIP_FAVOURED);
  @ ensures lasting: \result == false ==> s->rounds == \old(s->rounds) && s->trust == \old(s->trust) && s->confirmed == \old(s->confirmed) &&
  @   s->learns == \old(s->learns) && s->slipped == \old(s->slipped);
  @ ensures afresh: \result == true ==> s->open == false && s->leans == false && s->favoured == false;
  @ ensures confirmed: \result == true ==> (s->confirmed == true <==> \old(s->open) == false && sk_slip_weight(votes, blocks) == SK_SLIP_EXCLUDED);
  @ ensures learns: \result == true ==> (s->learns == true <==> \old(s->leans) == false && sk_slip_weight(votes, blocks) < SK_SLIP_LEANS);
  @ ensures gained: \result == true && s->confirmed == true ==> s->trust == sk_slip_no_more(\old(s->trust) + SK_SLIP_TRUST_GAIN, SK_SLIP_TRUST_MOST);
  @ ensures lost: \result == true && s->confirmed == false ==> s->trust == sk_slip_less(\old(s->trust));
  @ ensures again: \result == true && \old(s->trust) >= SK_SLIP_TRUST_LEAST && (\old(s->favoured) == true ||
  @   sk_slip_weight(votes, blocks) == SK_SLIP_FAVOURED) ==> s->rounds == sk_slip_no_more(\old(s->rounds) + 1, SK_SLIP_ROUNDS);
  @ ensures ended: \result == true && (\old(s->trust) < SK_SLIP_TRUST_LEAST || (\old(s->favoured) == false &&
  @   sk_slip_weight(votes, blocks) != SK_SLIP_FAVOURED)) ==> s->rounds == 0;
  @ ensures slipped: \result == true ==> (s->slipped == true <==> \old(s->slipped) == true || s->rounds >= SK_SLIP_ROUNDS);
  @*/
bool sk_slip_judge(sk_slip_state *s, int32_t votes, int32_t blocks);

SK_END
#endif
