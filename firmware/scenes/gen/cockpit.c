/* What flies with the eye: an instrument panel and the bow above it, in view space; a tail fin behind; and a cloud.
 *
 * SPDX-License-Identifier: MIT
 */
#include "gen.h"

void gen_cockpit(void)
{
}
