/* Threads, where there are none: none can be started, and what was meant for them is done by the one there is.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef WEB_PTHREAD_H
#define WEB_PTHREAD_H

typedef int pthread_t;
typedef int pthread_attr_t;
typedef int pthread_mutex_t;
#define PTHREAD_MUTEX_INITIALIZER 0

static inline int pthread_create(pthread_t *thread, const pthread_attr_t *how, void *(*run)(void *), void *with)
{
    (void)thread;
    (void)how;
    (void)run;
    (void)with;
    return 1;
}

static inline int pthread_join(pthread_t thread, void **result)
{
    (void)thread;
    (void)result;
    return 1;
}

static inline int pthread_mutex_lock(pthread_mutex_t *mutex)
{
    (void)mutex;
    return 0;
}

static inline int pthread_mutex_unlock(pthread_mutex_t *mutex)
{
    (void)mutex;
    return 0;
}

#endif
