/* Large blocks that are used again: see kept.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "kept.h"
#include <pthread.h>
#include <stdint.h>
#include <stdlib.h>
#ifdef __GLIBC__
#include <limits.h>
#include <malloc.h>
#endif

#if defined __has_feature /* clang's */
#if __has_feature(address_sanitizer)
#define __SANITIZE_ADDRESS__ 1
#endif
#endif
#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/asan_interface.h>
#define poison(at, bytes) __asan_poison_memory_region(at, bytes)
#define unpoison(at, bytes) __asan_unpoison_memory_region(at, bytes)
#else
#define poison(at, bytes) (void)(bytes)
#define unpoison(at, bytes) (void)(bytes)
#endif

#define KEPT 16                 /* blocks; who has more at a time takes new memory each time */
#define LEAST ((size_t)1 << 16) /* bytes */
#define ALIGN 64

/* While it is lent its addresses stand here inverted: LeakSanitizer would find it by them, and not report one that its
 * user has lost. */
static struct kept {
    char *memory; /* while it is free; NULL: none yet, or lent */
    size_t room;
    uintptr_t lent, lent_memory; /* ~ of what is in use of it, and of its start; 0: it is free */
} kept[KEPT];
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

/* The smallest free one that is large enough, or else one that may be made anew; NULL: all are in use. */
static struct kept *fitting(size_t room)
{
    struct kept *best = NULL, *other = NULL;
    for (struct kept *k = kept; k < kept + KEPT; k++) {
        if (k->lent != 0)
            continue;
        if (k->room >= room && (best == NULL || k->room < best->room))
            best = k;
        if (other == NULL || k->room < other->room)
            other = k;
    }
    return best != NULL ? best : other;
}

void *sim_kept(size_t bytes)
{
    size_t room = LEAST; /* doubled, so that blocks of other sizes fit into it */
    void *block = NULL;
    while (room <= bytes)
        room *= 2;
    (void)pthread_mutex_lock(&lock);
    struct kept *const k = fitting(room);
    if (k != NULL && k->room < room) {
        free(k->memory);
        k->memory = aligned_alloc(ALIGN, room);
        k->room = k->memory != NULL ? room : 0;
    }
    if (k != NULL && k->memory != NULL) {
        const size_t before = (k->room - bytes) / 4 * 4;
        unpoison(k->memory, k->room);
        poison(k->memory, before);
        poison(k->memory + before + bytes, k->room - bytes - before);
        block = k->memory + before;
        k->lent = ~(uintptr_t)block;
        k->lent_memory = ~(uintptr_t)k->memory;
        k->memory = NULL;
    }
    (void)pthread_mutex_unlock(&lock);
    return k != NULL ? block : malloc(bytes > 0 ? bytes : 1);
}

void sim_kept_end(void *block)
{
    struct kept *of = NULL;
    if (block == NULL)
        return;
    (void)pthread_mutex_lock(&lock);
    for (struct kept *k = kept; k < kept + KEPT; k++)
        of = k->lent == ~(uintptr_t)block ? k : of;
    if (of != NULL) {
        of->memory = (char *)~of->lent_memory;
        of->lent = 0;
        poison(of->memory, of->room);
    }
    (void)pthread_mutex_unlock(&lock);
    if (of == NULL)
        free(block);
}

void sim_keep_freed(void)
{
#ifdef __GLIBC__
    (void)mallopt(M_MMAP_THRESHOLD, 1 << 30);
    (void)mallopt(M_TRIM_THRESHOLD, INT_MAX);
#endif
}
