/* What errors are called.
 *
 * SPDX-License-Identifier: MIT
 */
#include "zstrip.h"

static const char *const messages[] = {
    "no error",
    "a required pointer is NULL",
    "frame, strip, pool or buffer count out of range",
    "the arena is too small or not aligned to 4 bytes",
    "depth bits outside 8 to 16, or a depth mapping that camera, method or shader cannot take",
    "near, far, focal length, height or rotation of the camera out of range",
    "a position, scale, extent or light the integers cannot hold, or a pose that is no rotation",
    "a mesh lacks what its shader reads, or has too many vertices",
    "frame functions called out of order",
    "the shader has more varyings than config.varyings, or a vertex stage and none",
    "a direction of length 0, or parallel directions",
    "the near plane is too close beside what is in view (more than 2^21 times as far): move it out",
    "a texture's size or clamping out of range",
    "the program was compiled with other headers or limits than the library",
    "a viewport outside the frame, a pass that keeps what is not there, or passes with a method"
};

const char *zs_error_string(int err)
{
    const unsigned n = 0u - (unsigned)err; /* a sink's own error, if > 0, gives a large one */
    return n < sizeof messages / sizeof messages[0] ? messages[n] : "unknown error";
}
