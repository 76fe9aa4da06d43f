/* Sentences of explanations, handed on piece by piece, as there is no memory for a whole one.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "support/explain.h"

static void flush(struct zs_explainer *e)
{
    e->text[e->n] = 0;
    e->say(e->ctx, e->text);
    e->n = 0;
}

static void put(struct zs_explainer *e, char c)
{
    e->text[e->n++] = c;
    if (e->n == ZS_EXPLAIN_PIECE - 1u)
        flush(e);
}

static void put_number(struct zs_explainer *e, int64_t v)
{
    char digit[20];
    int n = 0;
    uint64_t rest = v < 0 ? 0u - (uint64_t)v : (uint64_t)v;
    if (v < 0)
        put(e, '-');
    do {
        digit[n++] = (char)('0' + rest % 10u);
        rest /= 10u;
    } while (rest);
    while (n)
        put(e, digit[--n]);
}

/* A length in world units: three decimals below 10, none above. Any v: a refused camera may hold
 * anything. */
static void put_length(struct zs_explainer *e, zs_q48_16 v)
{
    const uint64_t size = v < 0 ? 0u - (uint64_t)v : (uint64_t)v;
    const int small = size < 10 * 65536;
    const uint32_t thousandths = small ? (uint32_t)((size * 1000u + 32768u) >> 16) : 0;
    if (v < 0)
        put(e, '-');
    put_number(e, (int64_t)(small ? thousandths / 1000u : (size + 32768u) >> 16));
    uint32_t rest = thousandths % 1000u;
    if (rest)
        put(e, '.');
    for (uint32_t unit = 100; rest; rest %= unit, unit /= 10u)
        put(e, (char)('0' + rest / unit));
}

void zs_explain_piece(struct zs_explainer *e, const char *form, const int64_t *number)
{
    for (; *form && e->said < ZS_EXPLAIN_MOST; form++) {
        if (*form == '%')
            put_number(e, *number++);
        else if (*form == '$')
            put_length(e, *number++);
        else
            put(e, *form);
    }
}

void zs_explain_say(struct zs_explainer *e, const char *form, const int64_t *number)
{
    if (e->said == ZS_EXPLAIN_MOST)
        return;
    zs_explain_piece(e, form, number);
    put(e, '\n');
    if (e->n)
        flush(e);
    e->said++;
}
