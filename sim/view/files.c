/* What stat says, mixed into one number.
 *
 * SPDX-License-Identifier: MIT
 */
#include "files.h"

#include <sys/stat.h>

#include "scene_file.h"

static void mix(uint64_t *to, uint64_t value)
{
    *to = (*to ^ value) * 0x9e3779b97f4a7c15u;
    *to ^= *to >> 29;
}

static void look(uint64_t *to, const char *name)
{
    struct stat st;
    if (name == NULL || stat(name, &st) != 0) {
        mix(to, 1);
        return;
    }
    mix(to, (uint64_t)st.st_ino);
    mix(to, (uint64_t)st.st_size);
    mix(to, (uint64_t)st.st_mtim.tv_sec);
    mix(to, (uint64_t)st.st_mtim.tv_nsec);
}

int view_files_changed(struct view_files *f, const struct view_words *words)
{
    uint64_t now = 1;
    look(&now, words->model);
    look(&now, view_words_get(words, "--texture"));
    look(&now, view_words_get(words, "--environment"));
    if (words->model == NULL)
        for (const char *const *name = sim_scene_file_sources(); *name != NULL; name++)
            look(&now, *name);
    const int changed = f->seen != 0 && f->seen != now;
    f->seen = now;
    return changed;
}
