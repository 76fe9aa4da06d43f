/* A small scene that is all right: a ball in five strips, of which a test changes one thing.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_GOOD_H
#define TESTS_GOOD_H

#include "zstrip.h"

struct good {
    struct zs_config config;
    struct zs_material material;
    struct zs_instance instance;
    struct zs_scene scene;
    struct zs_camera camera;
};

/* 40 by 30 pixels in strips of 7 rows. Its scene points to an instance that all of them share. */
struct good good_scene(void);

#endif
