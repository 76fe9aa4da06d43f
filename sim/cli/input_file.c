/* Files read whole.
 *
 * SPDX-License-Identifier: MIT
 */
#include "input_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "sim.h"

int sim_file_read(const char *name, uint8_t **bytes, size_t *n)
{
    struct stat st;
    FILE *f = fopen(name, "rb");
    *bytes = NULL;
    if (f == NULL || fstat(fileno(f), &st) != 0) {
        const int why = errno;
        if (f != NULL)
            (void)fclose(f);
        return sim_refuse(name, 0, "cannot be read: %s", strerror(why));
    }
    if (!S_ISREG(st.st_mode)) {
        (void)fclose(f);
        return sim_refuse(name, 0, "is not a regular file; %s",
                          S_ISDIR(st.st_mode) ? "name a file in it" : "write its bytes to one, and name that");
    }
    *n = (size_t)st.st_size;
    *bytes = sim_alloc(*n + 1, 1);
    const int whole = fread(*bytes, 1, *n, f) == *n;
    (void)fclose(f);
    if (whole)
        return SIM_OK;
    free(*bytes);
    *bytes = NULL;
    return sim_refuse(name, 0, "cannot be read to its end");
}
