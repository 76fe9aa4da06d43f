/* Settings that keys step through: each is an option of the command line.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_VIEW_SETTINGS_H
#define SIM_VIEW_SETTINGS_H

#include "shot.h"

struct view_setting {
    char key;
    const char *name, *option;
    const char *usual;  /* what is shown where the option is not given; NULL: by what was drawn */
    const char *values; /* "a|b|c": values to step through; NULL: the words of the option */
    double factor;      /* not 0: a number that grows by this */
    int usual_first;    /* flag: the first value is what it is where it is not given */
};
extern const struct view_setting view_settings[];
extern const int n_view_settings;

/* Does the command of the words have the option? */
int view_setting_there(const struct view_setting *s, const struct view_words *words);

/* Step on, or back. shot: what was drawn last. */
void view_setting_step(const struct view_setting *s, struct view_words *words, const struct view_shot *shot, int back);

#define VIEW_VALUE_MAX 64
/* The value that the words ask for, as it is shown. */
void view_setting_text(const struct view_setting *s, const struct view_words *words, const struct view_shot *shot,
                       char text[VIEW_VALUE_MAX]);

#endif
