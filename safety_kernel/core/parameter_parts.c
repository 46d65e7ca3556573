#include "parameter_parts.h"
#include "parameter_range.h"

/*@ requires -30000 <= a <= 30000 && -30000 <= b <= 30000;
  @ assigns \nothing;
  @ ensures \result == a * b && -900000000 <= \result <= 900000000;
  @*/
static int32_t product(int32_t a, int32_t b)
{
  return a * b;
}

/*@ requires \valid_read(q) && 0 <= a < BERM_PART_VERTICES && 0 <= b < BERM_PART_VERTICES && 0 <= c < BERM_PART_VERTICES;
  @ requires sk_vertex_ok(q, a) && sk_vertex_ok(q, b) && sk_vertex_ok(q, c);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_left_of(q, a, b, c);
  @*/
static bool left_of(const berm_part *q, int32_t a, int32_t b, int32_t c)
{
  int32_t bx = q->vertex_mm[b][0] - q->vertex_mm[a][0];
  int32_t bz = q->vertex_mm[b][1] - q->vertex_mm[a][1];
  int32_t cx = q->vertex_mm[c][0] - q->vertex_mm[a][0];
  int32_t cz = q->vertex_mm[c][1] - q->vertex_mm[a][1];
  return product(bx, cz) - product(bz, cx) > 0;
}

/*@ requires \valid_read(q) && sk_part_vertex_count_ok(q) && sk_part_vertices_ok(q) && 0 <= a < q->vertices && 0 <= b < q->vertices;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_edge_ok(q, a, b);
  @*/
static bool edge_ok(const berm_part *q, int32_t a, int32_t b)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= q->vertices;
    @ loop invariant \forall integer i; 0 <= i < k && i != a && i != b ==> sk_left_of(q, a, b, i);
    @ loop assigns k;
    @ loop variant q->vertices - k;
    @*/
  for (k = 0; k < q->vertices; k++) {
    if (k != a && k != b && !left_of(q, a, b, k)) { return false; }
  }
  return true;
}

/*@ requires \valid_read(q) && sk_part_vertex_count_ok(q) && sk_part_vertices_ok(q);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_part_convex(q);
  @*/
static bool part_convex(const berm_part *q)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= q->vertices - 1;
    @ loop invariant \forall integer a; 0 <= a < k ==> sk_turn_ok(q, a);
    @ loop assigns k;
    @ loop variant q->vertices - k;
    @*/
  for (k = 0; k < q->vertices - 1; k++) {
    if (!edge_ok(q, k, k + 1)) {
      /*@ assert !sk_turn_ok(q, k); */
      return false;
    }
  }
  return edge_ok(q, q->vertices - 1, 0);
}

/*@ requires \valid_read(q) && sk_part_vertex_count_ok(q);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_part_vertices_ok(q);
  @*/
static bool part_vertices_ok(const berm_part *q)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= q->vertices;
    @ loop invariant \forall integer i; 0 <= i < k ==> sk_vertex_ok(q, i);
    @ loop assigns k;
    @ loop variant q->vertices - k;
    @*/
  for (k = 0; k < q->vertices; k++) {
    if (!sk_is_within(q->vertex_mm[k][0], -15000, 15000) || !sk_is_within(q->vertex_mm[k][1], -15000, 15000)) {
      /*@ assert !sk_vertex_ok(q, k); */
      return false;
    }
  }
  return true;
}

/*@ requires \valid_read(p) && sk_rule_part_count(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_part_link(p);
  @*/
static bool part_links_ok(const berm_parameters *p)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= p->parts;
    @ loop invariant \forall integer i; 0 <= i < k ==> sk_part_link_ok(&p->part[i]);
    @ loop assigns k;
    @ loop variant p->parts - k;
    @*/
  for (k = 0; k < p->parts; k++) {
    if (!sk_is_within(p->part[k].link, 1, 3)) { return false; }
  }
  return true;
}

/*@ requires \valid_read(p) && sk_rule_part_count(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_part_width(p);
  @*/
static bool part_widths_ok(const berm_parameters *p)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= p->parts;
    @ loop invariant \forall integer i; 0 <= i < k ==> sk_part_width_ok(&p->part[i]);
    @ loop assigns k;
    @ loop variant p->parts - k;
    @*/
  for (k = 0; k < p->parts; k++) {
    if (!sk_is_within(p->part[k].half_width_mm, 1, 3000)) { return false; }
  }
  return true;
}

/*@ requires \valid_read(p) && sk_rule_part_count(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_part_vertex_count(p);
  @*/
static bool part_vertex_counts_ok(const berm_parameters *p)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= p->parts;
    @ loop invariant \forall integer i; 0 <= i < k ==> sk_part_vertex_count_ok(&p->part[i]);
    @ loop assigns k;
    @ loop variant p->parts - k;
    @*/
  for (k = 0; k < p->parts; k++) {
    if (!sk_is_within(p->part[k].vertices, 3, BERM_PART_VERTICES)) { return false; }
  }
  return true;
}

/*@ requires \valid_read(p) && sk_rule_part_count(p) && sk_rule_part_vertex_count(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_part_vertex_range(p);
  @*/
static bool part_vertex_ranges_ok(const berm_parameters *p)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= p->parts;
    @ loop invariant \forall integer i; 0 <= i < k ==> sk_part_vertices_ok(&p->part[i]);
    @ loop assigns k;
    @ loop variant p->parts - k;
    @*/
  for (k = 0; k < p->parts; k++) {
    if (!part_vertices_ok(&p->part[k])) { return false; }
  }
  return true;
}

/*@ requires \valid_read(p) && sk_rule_part_count(p) && sk_rule_part_vertex_count(p) && sk_rule_part_vertex_range(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_part_convex(p);
  @*/
static bool parts_convex(const berm_parameters *p)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= p->parts;
    @ loop invariant \forall integer i; 0 <= i < k ==> sk_part_convex(&p->part[i]);
    @ loop assigns k;
    @ loop variant p->parts - k;
    @*/
  for (k = 0; k < p->parts; k++) {
    if (!part_convex(&p->part[k])) { return false; }
  }
  return true;
}

/*@ requires \valid_read(p) && sk_rule_part_count(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_link_covered(p, link);
  @*/
static bool link_covered(const berm_parameters *p, int32_t link)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= p->parts;
    @ loop invariant \forall integer i; 0 <= i < k ==> p->part[i].link != link;
    @ loop assigns k;
    @ loop variant p->parts - k;
    @*/
  for (k = 0; k < p->parts; k++) {
    if (p->part[k].link == link) { return true; }
  }
  return false;
}

int32_t sk_check_parts(const berm_parameters *p)
{
  if (!sk_is_within(p->parts, 1, BERM_PARTS)) { return SK_RULE_PART_COUNT; }
  if (!part_links_ok(p)) { return SK_RULE_PART_LINK; }
  if (!part_widths_ok(p)) { return SK_RULE_PART_WIDTH; }
  if (!part_vertex_counts_ok(p)) { return SK_RULE_PART_VERTEX_COUNT; }
  if (!part_vertex_ranges_ok(p)) { return SK_RULE_PART_VERTEX_RANGE; }
  if (!parts_convex(p)) { return SK_RULE_PART_CONVEX; }
  if (!link_covered(p, 1) || !link_covered(p, 2) || !link_covered(p, 3)) { return SK_RULE_PART_EVERY_LINK; }
  return SK_RULE_NONE;
}
