/* zs_fast.draw of textures on cores whose registers hold 64 bits (fast/texture64.c). Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_TEXTURE64_H
#define ZS_TEXTURE64_H

struct zs_job;

int zs_texture64_draw(struct zs_job *job);     /* of a shader without light */
int zs_texture64_draw_lit(struct zs_job *job); /* of the others */

#endif
