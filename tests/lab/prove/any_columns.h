/* In the place of core/edges.c: a row's columns are any there can be.
 *
 * SPDX-License-Identifier: MIT
 */
void zs_edges_columns(struct zs_job *j, int32_t row)
{
    (void)row;
    for (int k = 0; k < ZS_CUT_ROWS; k++) {
        j->cut[k].x0 = (int16_t)any_i32(-(1 << 14) - 1, (1 << 14) + 1);
        j->cut[k].x1 = (int16_t)any_i32(-(1 << 14) - 1, (1 << 14) + 1);
    }
}
