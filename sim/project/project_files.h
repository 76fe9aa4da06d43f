/* The files of a project: templates with their @WORDS@ put in, and folders that are copied.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_PROJECT_FILES_H
#define SIM_PROJECT_FILES_H

#include <stddef.h>

/* @name@ of a template becomes text. */
struct sim_word {
    const char *name, *text;
};

/* The folder of zstrip's sources: above the program's own file, or $ZSTRIP. malloc'ed; NULL, said why, where there is
 * none. */
char *sim_sources_find(void);

/* Write the file `to` from the template `from`. SIM_OK; SIM_REFUSED, said why. */
int sim_template_write(const char *from, const char *to, const struct sim_word *word, size_t n);

/* Copy a folder or file and all that is in it; folders above `to` are made. SIM_OK; SIM_REFUSED, said why. */
int sim_tree_copy(const char *from, const char *to);

/* Remove a folder and all that is in it. */
void sim_tree_remove(const char *folder);

#endif
