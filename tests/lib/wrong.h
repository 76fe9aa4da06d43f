/* A sentence that says what is wrong, on standard error.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_WRONG_H
#define TESTS_WRONG_H

#include <stdarg.h>
#include <stdio.h>

/* before: what stands before "wrong". Return 0, what a case that is wrong returns. */
static inline __attribute__((format(printf, 2, 3))) int wrong_said(const char *before, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    fprintf(stderr, "%swrong: ", before);
    vfprintf(stderr, format, args);
    fputc('\n', stderr);
    va_end(args);
    return 0;
}

#endif
