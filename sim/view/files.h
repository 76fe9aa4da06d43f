/* Files that a picture is drawn from, and whether they have changed.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_VIEW_FILES_H
#define SIM_VIEW_FILES_H

#include <stdint.h>

#include "words.h"

/* All zero before the first look. */
struct view_files {
    uint64_t seen;
};

/* Look at the files that the words name. Return 1 if one is not as it was at the last look, which there was. */
int view_files_changed(struct view_files *f, const struct view_words *words);

#endif
