/* Polygons to triangles: the twin of sim/load/polygon.c, which says how. What one of them computes, the other one does
 * in the same order, so that both give the same triangles.
 *
 * SPDX-License-Identifier: MIT
 */

/** Twice the area of a triangle, > 0 where a, b, c turn left. */
function turn(a, b, c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
}

/** Twice the vector of the polygon's area, by the corners' distances from the first one. */
function areaOf(point) {
    const out = [0, 0, 0],
        from = (i) => [0, 1, 2].map((k) => point[i][k] - point[0][k]);
    for (let i = 1; i + 1 < point.length; i++) {
        const a = from(i),
            b = from(i + 1);
        for (let k = 0; k < 3; k++) out[k] += a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
    return out;
}

/** The corners without the axis along which the area is largest, counter-clockwise. */
function flatten(point) {
    const area = areaOf(point);
    let axis = 0;
    for (let k = 1; k < 3; k++) if (Math.abs(area[k]) > Math.abs(area[axis])) axis = k;
    const plane = [(axis + 1) % 3, (axis + 2) % 3];
    if (area[axis] < 0) plane.reverse();
    return point.map((p) => plane.map((k) => p[k] - point[0][k]));
}

const same = (a, b) => a[0] === b[0] && a[1] === b[1];

/** A polygon on a plane: a ring of the corners that are left, and those of them that turn inwards. */
class Ring {
    constructor(at) {
        const n = at.length;
        this.at = at;
        this.next = at.map((_, i) => (i + 1) % n);
        this.last = at.map((_, i) => (i + n - 1) % n);
        this.known = at.map(() => undefined);
        this.inward = at.map((_, i) => i).filter((i) => this.isInward(i));
    }

    corners(i) {
        return [this.at[this.last[i]], this.at[i], this.at[this.next[i]]];
    }

    isInward(i) {
        return turn(...this.corners(i)) <= 0;
    }

    isEar(i) {
        const [a, b, c] = this.corners(i);
        if (!(turn(a, b, c) > 0)) return false;
        return this.inward.every((j) => {
            const p = this.at[j];
            if (same(p, a) || same(p, b) || same(p, c)) return true;
            return !(turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0);
        });
    }

    ear(from, left) {
        for (let i = 0, at = from; i < left; i++, at = this.next[at]) {
            this.known[at] ??= this.isEar(at);
            if (this.known[at]) return at;
        }
        return from;
    }

    drop(i) {
        const at = this.inward.indexOf(i);
        if (at >= 0) this.inward[at] = this.inward[this.inward.length - 1];
        if (at >= 0) this.inward.pop();
    }

    cut() {
        const out = [];
        for (let at = 1, left = this.at.length; left > 2; left--) {
            if (this.inward.length > 0) at = this.ear(at, left);
            const before = this.last[at],
                after = this.next[at];
            out.push([before, at, after]);
            this.next[before] = after;
            this.last[after] = before;
            this.known[before] = this.known[after] = undefined;
            this.drop(at);
            for (const beside of [before, after]) if (!this.isInward(beside)) this.drop(beside);
            at = this.inward.length > 0 ? this.next[after] : after;
        }
        return out;
    }
}

/** Numbers of corners, three to a triangle. @param {number[][]} point the corners, in order */
export function cutPolygon(point) {
    const n = point.length,
        at = flatten(point);
    const inward = (p, i) => turn(p, at[(i + 1) % n], at[(i + 2) % n]) < 0,
        flat = (_, i) => i + 2 < n && turn(at[0], at[i + 1], at[i + 2]) === 0;
    if (!at.some(inward) && !at.some(flat)) return at.slice(2).map((_, i) => [0, i + 1, i + 2]);
    return new Ring(at).cut();
}
