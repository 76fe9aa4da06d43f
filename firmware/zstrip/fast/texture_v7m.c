/* Small textured triangles on Armv7-M, in assembler, one triangle of the list after the other:
 * set-up, rows and pixels without a call; the rows of lit ones are those of fast/fast_texels.c. On
 * a Cortex-M3 it saves 23 % of scene relief_tex (0.63 of 2.75 million instructions), 18 % of
 * mesh_tex, 8 % of crowd, 5 % of mesh_tex_lit and mesh_tex_smooth: set-up and list take some 380
 * instructions a triangle in place of 570, a row 34 in place of 39, 14 if it is empty, a pixel 16
 * in place of 17. 2,470 bytes for all formats; the functions in C take 2,120 for one, unlit.
 *
 * Exact: what is drawn here is drawn as by fast/fast_texture.c and fast/fast_texels.c, bit for bit.
 * tests/checks/v7m.c compares them on an emulated M3 and M7. Declined are those that C declines,
 * but for those without a row here, and some with a gradient of a quarter of a repeat a pixel or
 * more (C: a half).
 *
 * A gradient is 256 n / area 2^(32 - uv_bits) = n rcp / 2^shift (shade/texture.h), shift = 32 - up.
 * For up >= 0 it is the high word of (n 2^up) rcp + 2^31: |n| < 2^(shift - 1) is tested, so that
 * n 2^up fits. rcp is 2^31 or more, and taken as a signed factor it is less by 2^32, for which
 * n 2^up is added to the high word. For up < 0, it is the high word of n rcp, shifted on.
 *
 * SPDX-License-Identifier: MIT
 */
#include "fast/texture_v7m.h"
#include "core/pass.h"

#if ZS_V7M

#include "fast/small_v7m.h"
#include "shade/texture.h"
#include "zs_fast.h"

/* The stack: struct zs_texture_hand. SIDE: span and step of the left side; SIDE_2: of the right
 * one. The rest is as in fast/solid_v7m.c. */
#define F_SIDE 0
#define F_SIDE_2 8
#define F_SUMS 24
#define F_ROW 40
#define F_END 48
#define F_TURN 56
#define F_NEXT 60
#define F_STEP 64
#define F_SUM 68
#define F_KEY 72
#define F_U 76
#define F_V 80
#define F_KEY_DOWN 88
#define F_U_DOWN 92
#define F_V_DOWN 96
#define F_KEY_RIGHT 100
#define F_U_RIGHT 104
#define F_V_RIGHT 108
#define F_D1 136
#define F_D2 144
#define F_RCP 152
#define F_X 160
#define F_TWO 160 /* room for two registers, before x is known */
#define F_TWO_2 164
#define F_CHANGE 168
#define F_A 172
#define F_LIMIT 180
#define F_TRI 184
#define F_DRAWN 188
#define F_TRI_END 192
#define F_TESTED 196
#define F_SET_UP 200
#define F_LIT 204
#define F_JOB 208
#define F_KEPT 212 /* what is the same for all triangles of the list: */
#define F_CUTS 212
#define F_WIDTH 220
#define F_PALETTE 228
#define F_PIXEL 232
#define F_UP 236
#define F_BITS 244
#define F_BIAS 252
#define F_SHIFT 260
#define F_LAST 264
#define F_ATTR 268
#define F_POOL 276
#define F_EDGE 280
#define F_WIDTH_PX 284
#define F_Y0 288
#define F_Y1 292
#define F_PITCH 296
#define F_BASE 300
#define F_BESIDE 304
#define F_ALL 308
#define F_KEEP 312
#define F_INSTANCE 316
#define F_BYTES 328
#define COPIED 108
#define IS(name, field) (F_##name == offsetof(struct zs_texture_hand, field))
_Static_assert(IS(SIDE, w.sides.side) && IS(SUMS, w.sides.sum) && IS(ROW, w.sides.row) &&
                   IS(END, w.sides.end) && IS(TURN, w.sides.turn) && IS(NEXT, w.sides.next) &&
                   IS(SUM, w.sides.next_sum) && IS(KEY, w.at) && IS(KEY_DOWN, w.down) &&
                   IS(KEY_RIGHT, w.right) && IS(D1, dx1) && IS(D2, dx2) && IS(RCP, rcp) &&
                   IS(X, x) && IS(CHANGE, change) && IS(A, a) && IS(LIMIT, limit) && IS(TRI, tri),
               "of the triangle");
_Static_assert(IS(DRAWN, drawn) && IS(TRI_END, tri_end) && IS(TESTED, tested) &&
                   IS(SET_UP, set_up) && IS(LIT, lit) && IS(JOB, job) && IS(KEPT, of) &&
                   F_BYTES % 8 == 0 && F_BYTES >= sizeof(struct zs_texture_hand) &&
                   COPIED == offsetof(struct zs_kept, of),
               "of the list");
_Static_assert(IS(CUTS, of.row) && IS(WIDTH, of.width) && IS(PALETTE, of.palette) &&
                   IS(PIXEL, of.pixel) && IS(UP, of.up) && IS(BITS, of.bits) &&
                   IS(BIAS, of.bias) && IS(SHIFT, of.shift) && IS(LAST, of.last) &&
                   IS(ATTR, of.attr) && IS(POOL, of.pool) && IS(EDGE, of.edge),
               "of the instance");
_Static_assert(IS(WIDTH_PX, of.width_px) && IS(Y0, of.y0) && IS(Y1, of.y1) &&
                   IS(PITCH, of.pitch) && IS(BASE, of.base) && IS(BESIDE, of.beside) &&
                   IS(ALL, of.all) && IS(KEEP, of.keep) && IS(INSTANCE, of.chain),
               "of the instance");

/* The change of depth, for affinity and light. */
#define CHANGE                                                                                     \
    "adds r5, r11, r4\n\tand r5, r5, r5, asr #31\n\tsub r12, r5, r4\n\tsub r5, r11, r5\n\t"        \
    "bic r5, r5, r5, asr #31\n\tand r12, r12, r12, asr #31\n\tsub r5, r5, r12\n\t"                 \
    "str r5, " AT(CHANGE) "\n\tstrd r9, r10, " AT(D1) "\n\tstrd r2, r3, " AT(D2) "\n\t"

/* What SIDES has found, for the rows. */
#define STORE                                                                                      \
    "strd r5, r11, " AT(SUMS) "\n\tstr r8, " AT(KEY) "\n\tstr r12, " AT(KEY_DOWN) "\n\t"           \
    "str r0, " AT(KEY_RIGHT) "\n\t"

/* Attributes: r7 and r8, r9 are u of the top vertex and the others' differences; r10 and r11, r12
 * are v. 9f if they span 2^14 or more, or affine interpolation is not exact enough. 25f: they span
 * less than half a texel, counting at least 128 to a repeat; back at 24. */
#define RANGE(out, d1, d2, low)                                                                    \
    "sub " out ", " d1 ", " d2 "\n\tand " out ", " out ", " out ", asr #31\n\t"                    \
    "add " low ", " d2 ", " out "\n\tsub " out ", " d1 ", " out "\n\t"                             \
    "bic " out ", " out ", " out ", asr #31\n\tand " low ", " low ", " low ", asr #31\n\t"         \
    "sub " out ", " out ", " low "\n\t"
#define ATTRIBUTES                                                                                 \
    "ldr r1, " AT(TRI) "\n\tldrd r5, r6, " AT(ATTR) "\n\t"                                         \
    "ldrh r2, [r1]\n\tldrh r3, [r1, #2]\n\tldrh r4, [r1, #4]\n\t"                                  \
    "mla r2, r2, r6, r5\n\tmla r3, r3, r6, r5\n\tmla r4, r4, r6, r5\n\t"                           \
    "ldrh r7, [r2]\n\tldrh r8, [r3]\n\tldrh r9, [r4]\n\t"                                          \
    "ldrh r10, [r2, #2]\n\tldrh r11, [r3, #2]\n\tldrh r12, [r4, #2]\n\t"                           \
    "sub r8, r8, r7\n\tsub r9, r9, r7\n\tsub r11, r11, r10\n\tsub r12, r12, r10\n\t"               \
    RANGE("r0", "r8", "r9", "r1") RANGE("r2", "r11", "r12", "r1")                                  \
    "orr r1, r0, r2\n\tlsrs r1, r1, #14\n\tbne 9f\n\tldrd r3, r4, " AT(UP) "\n\t"                  \
    "orr r0, r0, #1\n\tlsls r0, r3\n\torr r2, r2, #1\n\tlsls r2, r4\n\torrs r0, r2\n\t"            \
    "clz r0, r0\n\tldrd r3, r4, " AT(BITS) "\n\tldr r1, " AT(CHANGE) "\n\t"                        \
    "subs r3, r3, r0\n\tbmi 25f\n\tlsrs r4, r3\n\tcmp r1, r4\n\tbhi 9f\n"                          \
    "24:\n\tstrd r7, r10, " AT(A) "\n\t"
#define NARROW                                                                                     \
    "25:\n\trsbs r3, r3, #0\n\tlsr r3, r1, r3\n\tcmp r3, r4\n\tbcc 24b\n\tb 9b\n"

/* Gradients: at U_RIGHT and so on. up = 32 - shift: r1; 26f: it is below 0; back at 27. */
#define NUMERATOR(d1, by1, d2, by2)                                                                \
    "mul r10, " d1 ", " by1 "\n\tmls r10, " d2 ", " by2 ", r10\n\t"
#define GRADIENT(d1, by1, d2, by2, to, test)                                                       \
    NUMERATOR(d1, by1, d2, by2) test "\n\tlsl r10, r10, r1\n\tmov r7, #0x80000000\n\t"             \
    "smlal r7, r10, r10, r6\n\tstr r10, " to "\n\t"
#define TEST "add r7, r10, lr\n\torrs r0, r7"
#define GRADIENTS                                                                                  \
    "ldrd r2, r4, " AT(D1) "\n\tldrd r3, r5, " AT(D2) "\n\tldrd r6, r0, " AT(RCP) "\n\t"           \
    "ldr r1, " AT(BITS) "\n\tsubs r1, #1\n\tsubs r1, r1, r0\n\tbmi 26f\n\t"                        \
    "mov lr, #0x80000000\n\tlsr lr, lr, r1\n\t"                                                    \
    GRADIENT("r8", "r5", "r9", "r4", AT(U_RIGHT), "add r0, r10, lr")                               \
    GRADIENT("r9", "r2", "r8", "r3", AT(U_DOWN), TEST)                                             \
    GRADIENT("r11", "r5", "r12", "r4", AT(V_RIGHT), TEST)                                          \
    GRADIENT("r12", "r2", "r11", "r3", AT(V_DOWN), TEST)                                           \
    "rsb r1, r1, #32\n\tlsrs r0, r1\n\tbne 9f\n27:\n\t"
#define GENTLE(d1, by1, d2, by2, to)                                                               \
    NUMERATOR(d1, by1, d2, by2) "movs r7, #0\n\tsmlal r7, r10, r10, r6\n\tadd r10, r10, lr\n\t"    \
    "asr r10, r10, r1\n\tstr r10, " to "\n\t"
#define GENTLY                                                                                     \
    "26:\n\trsbs r1, r1, #0\n\tmov lr, #1\n\tlsl lr, lr, r1\n\tlsr lr, lr, #1\n\t"                 \
    GENTLE("r8", "r5", "r9", "r4", AT(U_RIGHT)) GENTLE("r9", "r2", "r8", "r3", AT(U_DOWN))         \
    GENTLE("r11", "r5", "r12", "r4", AT(V_RIGHT)) GENTLE("r12", "r2", "r11", "r3", AT(V_DOWN))     \
    "b 27b\n"

/* u and v at column 0 of the first row, as zs_texture_plane. */
#define PLACE_OF(low, high, right, down, a, bias)                                                  \
    "smull " low ", " high ", " right ", r6\n\tsmlal " low ", " high ", " down ", r7\n\t"          \
    "adds " low ", " low ", #128\n\tadc " high ", " high ", #0\n\tlsr " low ", " low ", #8\n\t"    \
    "orr " low ", " low ", " high ", lsl #24\n\tlsl " a ", " a ", r10\n\t"                         \
    "add " low ", " low ", " a "\n\tadd " low ", " low ", " bias "\n\t"
#define BASES                                                                                      \
    "ldrd r2, r3, " AT(U_RIGHT) "\n\tldrd r4, r5, " AT(U_DOWN) "\n\tldrd r6, r7, " AT(X) "\n\t"    \
    "ldrd r8, r9, " AT(A) "\n\tldr r10, " AT(BITS) "\n\tldrd r11, r12, " AT(BIAS) "\n\t"           \
    "rsbs r6, r6, #0\n\t"                                                                          \
    PLACE_OF("r0", "r1", "r2", "r4", "r8", "r11") PLACE_OF("r1", "lr", "r3", "r5", "r9", "r12")    \
    "strd r0, r1, " AT(U) "\n\t"

/* Rows. r0, r5, r7: what a pixel adds to the key, u and v; r2: from a key to its colour; r10, r11:
 * width and texels. Low bytes of r8 and r9: shifts of v and u (a shift by a register takes no
 * more). Above them, in r8: pixels left in the row, less one; in r9: pixels so far, below 2^14, and
 * from bit 24 rows so far, at most 64. In a row, r3, r4, r6: key, u, v; r1: a key before that of
 * the pixel. The loops of formats end at 11. */
#define ROWS                                                                                       \
    "ldrd r5, r7, " AT(U_RIGHT) "\n\tldr r0, " AT(KEY_RIGHT) "\n\tldr r2, " AT(BESIDE) "\n\t"      \
    "ldrd r8, r9, " AT(CUTS) "\n\tldrd r10, r11, " AT(WIDTH) "\n\t"                                \
    "ldr r1, " AT(SET_UP) "\n\tadds r1, #1\n\tstr r1, " AT(SET_UP) "\n\t"                          \
    "ldr r1, " AT(LIMIT) "\n\tcbz r1, 12f\n"                                                       \
    "10:\n\t" /* a row */                                                                          \
    "ldrd r1, r3, " AT(SIDE) "\n\tldrd r4, r6, " AT(SUMS) "\n\tudiv r1, r4, r1\n\tadd r4, r3\n\t"  \
    "ldrd r3, r12, " AT(SIDE_2) "\n\tudiv r3, r6, r3\n\tadd r6, r12\n\t"                           \
    "strd r4, r6, " AT(SUMS) "\n\tsubs r3, r3, r1\n\tbls 11f\n\t"                                  \
    "add r9, r9, r3, lsl #8\n\tadd r8, r8, r3, lsl #8\n\tlsr r12, r9, #24\n\t"                     \
    "ldrd r3, r4, " AT(KEY) "\n\tldr r6, " AT(V) "\n\t"                                            \
    "mla r3, r0, r1, r3\n\tmla r4, r5, r1, r4\n\tmla r6, r7, r1, r6\n\t"                           \
    "ldr lr, " AT(KEY_DOWN) "\n\tmla r3, lr, r12, r3\n\tldr lr, " AT(U_DOWN) "\n\t"                \
    "mla r4, lr, r12, r4\n\tldr lr, " AT(V_DOWN) "\n\tmla r6, lr, r12, r6\n\t"                     \
    "ldr lr, " AT(PITCH) "\n\tmul r12, lr, r12\n\tldr lr, " AT(ROW) "\n\t"                         \
    "add r12, r12, r1, lsl #1\n\tadd r1, lr, r12\n\tldr pc, " AT(PIXEL) "\n"                       \
    "12:\n\tldr r3, " AT(END) "\n\tcmp r1, r3\n\tbeq 7f\n\tstr r3, " AT(LIMIT) "\n\t"              \
    "ldrd r1, r3, " AT(NEXT) "\n\tldr r4, " AT(SUM) "\n\tldr r6, " AT(TURN) "\n\t"                 \
    "add r12, sp, r6, lsl #3\n\tstrd r1, r3, [r12]\n\tadd r12, sp, r6, lsl #2\n\t"                 \
    "str r4, [r12, #24]\n\tb 10b\n"
#define VISIBLE                                                                                    \
    "ldrh r12, [r1, #2]!\n\tcmp r12, r3, lsr #16\n\tbls 19f\n\tlsr r12, r3, #16\n\t"               \
    "strh r12, [r1]\n\tlsr r12, r6, r8\n\tlsr lr, r4, r9\n\tmla r12, r12, r10, lr\n\t"
#define STEP(loop)                                                                                 \
    "rev16 r12, r12\n\tstrh r12, [r1, r2]\n"                                                       \
    "19:\n\tadd r3, r0\n\tadd r4, r5\n\tadd r6, r7\n\tsubs r8, #256\n\tbcs " loop "\n\t"
#define PIXELS                                                                                     \
    "31:\n\t" VISIBLE "ldrh r12, [r11, r12, lsl #1]\n\t" STEP("31b")                               \
    "11:\n\tadd r9, r9, #0x1000000\n\tldr r1, " AT(LIMIT) "\n\tcmp r1, r9, lsr #24\n\tbne 10b\n\t" \
    "b 12b\n"                                                                                      \
    "32:\n\t" VISIBLE "ldrb r12, [r11, r12]\n\tldr lr, " AT(PALETTE) "\n\t"                        \
    "ldrh r12, [lr, r12, lsl #1]\n\t" STEP("32b") "b 11b\n"                                        \
    "33:\n\t" VISIBLE "lsrs lr, r12, #1\n\tldrb r12, [r11, lr]\n\tit cs\n\tlsrcs r12, r12, #4\n\t" \
    "and r12, r12, #15\n\tldr lr, " AT(PALETTE) "\n\tldrh r12, [lr, r12, lsl #1]\n\t" STEP("33b")  \
    "b 11b\n"                                                                                      \
    "7:\n\tldr r1, " AT(TESTED) "\n\tubfx r3, r9, #8, #16\n\tadds r1, r1, r3\n\t"                  \
    "str r1, " AT(TESTED) "\n"

/* Seven words of job->kept to the stack. */
#define COPY                                                                                       \
    "ldmia r0!, {r4, r5, r6, r7, r8, r9, r10}\n\tstmia r2!, {r4, r5, r6, r7, r8, r9, r10}\n\t"

/* Set job->kept for the instance of job->tri. Return 0: none of its triangles is drawn here. */
static int begin(struct zs_job *job)
{
    const struct zs_renderer *const r = job->r;
    const struct zs_texture *const t = job->texture;
    struct zs_kept *const k = &job->kept;
    const uint32_t log2_w = t->log2_w, log2_h = t->log2_h, shift = r->view.piece_shift,
                   uv_bits = zs_instance_of(r, job->tri->instance)->mesh->uv_bits,
                   bias = 1u << (32u - ZS_TEXTURE_BIAS_LOG2);
    /* a piece has depths that differ by at most key_slow, and key_known is the end of one */
    if (!job->texel || t->clamp || !log2_w || !log2_h || r->view.key_slow != (1u << shift) - 1u)
        return 0;
    k->row = 32u - log2_h - 256u;
    k->column = 32u - log2_w;
    k->width = 1u << log2_w;
    k->texel = t->texel;
    k->palette = t->palette;
    k->pixel = 4u - t->format->log2_bits; /* formats with loops: 565, pal8, pal4 */
    k->up[0] = zs_maxu32(log2_w, ZS_TEXTURE_FLOOR_LOG2);
    k->up[1] = zs_maxu32(log2_h, ZS_TEXTURE_FLOOR_LOG2);
    k->bits = 32u - uv_bits;
    k->slow = r->view.key_slow >> (ZS_SPAN_BOUND_LOG2 - 2);
    k->bias[0] = bias >> log2_w;
    k->bias[1] = bias >> log2_h;
    k->shift = shift;
    k->last = r->view.key_known + 1u;
    k->attr = r->attr;
    k->attr_bytes = r->config.varyings * 2u;
    k->pool = r->vert;
    k->edge = (uint32_t)zs_max32(job->width - 2 * ZS_TINY_SIDE + 1, 0);
    k->width_px = job->width;
    k->y0 = job->y0;
    k->y1 = job->y1;
    k->pitch = (uint32_t)job->pitch * 2u;
    k->base = (uintptr_t)job->depth - (uint32_t)job->y0 * k->pitch - 2u;
    k->beside = (uintptr_t)job->color - (uintptr_t)job->depth;
    k->all = r->tri;
    k->keep = job->keep;
    k->chain = job->chain ? job->tri->instance : 0x10000u;
    k->of = job->tri->instance;
    return 1;
}

/* Return what zs_fast.draw returns. all: no triangle was declined. */
static int end(struct zs_job *job, const struct zs_texture_hand *h, int all)
{
    job->r->stats.pixels_tested += h->tested;
    job->r->stats.tris_setup += h->set_up;
    if (!all)
        return zs_small_declined(job, h->drawn);
    job->tri = h->drawn;
    job->tri_end = h->tri_end;
    return 1;
}

/* Called for each triangle of a shader with light. */
static ZS_NOINLINE int shine(struct zs_job *job, struct zs_texture_hand *h)
{
    return job->fast->shine(job, h);
}

ZS_NAKED int zs_texture_v7m(struct zs_job *job ZS_TAKEN)
{
    __asm__ volatile(
        ".syntax unified\n\t"
        "push {r3, r4, r5, r6, r7, r8, r9, r10, r11, lr}\n\tsub sp, #" NUMBER(F_BYTES) "\n\t"
        "ldr r1, [r0, %[fast]]\n\tldr r1, [r1, %[shine]]\n\tstrd r1, r0, " AT(LIT) "\n\t"
        "ldr r3, [r0, %[tri]]\n\tldrh r3, [r3, #10]\n\t"
        "ldr r2, [r0, %[of]]\n\tcmp r2, r3\n\tbeq 36f\n\tbl %c[begin]\n\tcmp r0, #0\n\tbeq 35f\n\t"
        "ldr r0, " AT(JOB) "\n"
        "36:\n\tldr r1, [r0, %[tri]]\n\tadd r0, r0, %[kept]\n\t"
        "add r2, sp, #" NUMBER(F_KEPT) "\n\t"
        COPY COPY COPY COPY
        "ldr r2, " AT(PIXEL) "\n\tadr r3, 34f\n\tldr r2, [r3, r2, lsl #2]\n\t"
        "str r2, " AT(PIXEL) "\n\tmovs r2, #0\n\tstr r2, " AT(DRAWN) "\n\t"
        "str r2, " AT(TESTED) "\n\t"
        "str r2, " AT(SET_UP) "\n"
        "1:\n\tstr r1, " AT(TRI) "\n\t"
        LOOK CHANGE RECIPROCAL "strd r1, r5, " AT(RCP) "\n\t"
        QUOTIENT("r0", "r12", "lr", "r3", "r10", "21f", "3")
        QUOTIENT("r12", "lr", "r4", "r2", "r9", "22f", "4")
        PLACE
        "ldr r5, " AT(BASE) "\n\tadd r4, r5, r4, lsl #1\n\tldr r5, " AT(PITCH) "\n\t"
        "mla lr, lr, r5, r4\n\tstrd lr, r1, " AT(ROW) "\n\tstr r11, " AT(END) "\n\t"
        "str r1, " AT(LIMIT) "\n\tstrd r6, r7, " AT(X) "\n\t"
        SIDES("r1", "r11") STORE ATTRIBUTES GRADIENTS BASES
        "ldr r4, " AT(LIT) "\n\tcmp r4, #0\n\tbne 28f\n"
        "29:\n\t" ROWS PIXELS NEXT
        "20:\n9:\n\tldr r0, " AT(DRAWN) "\n\tcbz r0, 35f\n\tmovs r2, #0\n\tb 19f\n"
        "18:\n\tmovs r2, #1\n"
        "19:\n\tldr r0, " AT(JOB) "\n\tmov r1, sp\n\tbl %c[end]\n"
        "35:\n\tadd sp, #" NUMBER(F_BYTES) "\n\tpop {r3, r4, r5, r6, r7, r8, r9, r10, r11, pc}\n"
        "28:\n\tldr r0, " AT(JOB) "\n\tmov r1, sp\n\tbl %c[called]\n\tcmp r0, #1\n\tbhi 29b\n\t"
        "blo 9b\n\t"
        "ldr r1, " AT(SET_UP) "\n\tadds r1, #1\n\tstr r1, " AT(SET_UP) "\n\tb 8b\n"
        "21:\n\t" BIG("r0", "r12", "3b")
        "22:\n\t" BIG("r12", "lr", "4b")
        NARROW GENTLY NEAR_SIDES("ldr r11, " AT(WIDTH_PX)) GOES_ON("ldr r4, " AT(KEEP))
        ".align 2\n30:\n\t.word zs_recip_table, 0xaaaaaaab\n"
        "34:\n\t.word 31b + 1, 32b + 1, 33b + 1\n"
        :
        : [fast] "i"(offsetof(struct zs_job, fast)), [shine] "i"(offsetof(struct zs_fast, shine)),
          [called] "i"(shine), [begin] "i"(begin), [end] "i"(end),
          [tri] "i"(offsetof(struct zs_job, tri)), [kept] "i"(offsetof(struct zs_job, kept)),
          [of] "i"(offsetof(struct zs_job, kept.of)));
}

#endif
