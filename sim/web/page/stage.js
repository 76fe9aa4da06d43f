/* The glass: exact pixels, enlarged by whole numbers; turning by pointer, wheel, pinch and keys; a strip at a time.
 *
 * SPDX-License-Identifier: MIT
 */
import { id, make } from './dom.js';

export const HOME = { yaw: 25, pitch: 20, distance: 1 };
const between = (v, lo, hi) => Math.min(hi, Math.max(lo, v));

export class Stage {
    /** moved: called after the view has changed. */
    constructor(moved) {
        this.moved = moved;
        this.view = { ...HOME };
        this.canvas = id('glass');
        this.context = this.canvas.getContext('2d', { alpha: false });
        this.image = null;
        this.fingers = new Map();
        this.wanted = 0;
        this.listen();
        new ResizeObserver(() => this.fit()).observe(id('board').parentElement);
    }

    turnBy(yaw, pitch, nearer) {
        const v = this.view;
        v.yaw = (v.yaw + yaw + 720) % 360;
        v.pitch = between(v.pitch + pitch, -89, 89);
        v.distance = between(v.distance * nearer, 0.25, 6);
        this.moved();
    }

    goHome() {
        Object.assign(this.view, HOME);
        this.moved();
    }

    listen() {
        const c = this.canvas;
        c.addEventListener('pointerdown', (e) => {
            c.setPointerCapture(e.pointerId);
            this.fingers.set(e.pointerId, [e.clientX, e.clientY]);
        });
        c.addEventListener('pointermove', (e) => this.drag(e));
        for (const end of ['pointerup', 'pointercancel'])
            c.addEventListener(end, (e) => this.fingers.delete(e.pointerId));
        c.addEventListener(
            'wheel',
            (e) => {
                e.preventDefault();
                this.turnBy(0, 0, Math.exp(between(e.deltaY, -200, 200) / 600));
            },
            { passive: false },
        );
        c.addEventListener('keydown', (e) => {
            const moves = {
                ArrowLeft: [-6, 0, 1],
                ArrowRight: [6, 0, 1],
                ArrowUp: [0, 6, 1],
                ArrowDown: [0, -6, 1],
                '+': [0, 0, 1 / 1.1],
                '=': [0, 0, 1 / 1.1],
                '-': [0, 0, 1.1],
            };
            if (e.ctrlKey || e.metaKey || e.altKey) return;
            if (moves[e.key]) this.turnBy(...moves[e.key]);
            else if (e.key === '0') this.goHome();
            else return;
            e.preventDefault();
        });
    }

    drag(e) {
        const was = this.fingers.get(e.pointerId);
        if (!was) return;
        const now = [e.clientX, e.clientY],
            others = [...this.fingers].filter(([n]) => n !== e.pointerId);
        this.fingers.set(e.pointerId, now);
        if (others.length === 0) {
            this.turnBy(-0.5 * (now[0] - was[0]), 0.5 * (now[1] - was[1]), 1);
        } else if (others.length === 1) {
            const o = others[0][1],
                far = (p) => Math.hypot(p[0] - o[0], p[1] - o[1]) + 1;
            this.turnBy(0, 0, far(was) / far(now));
        }
    }

    /** Room for a frame of that size. */
    resize(width, height) {
        if (this.image && this.image.width === width && this.image.height === height) return;
        this.canvas.width = width;
        this.canvas.height = height;
        this.image = this.context.createImageData(width, height);
        this.fit();
    }

    show() {
        this.context.putImageData(this.image, 0, 0);
    }

    /** Enlarge by the greatest whole number that fits, or by the one that is wanted. Device pixels count. */
    fit() {
        if (!this.image) return;
        const board = id('board'),
            style = getComputedStyle(board),
            inner = getComputedStyle(this.canvas.parentElement);
        const edges = ['paddingLeft', 'paddingRight'].reduce(
            (s, p) => s + parseFloat(style[p]) + parseFloat(inner[p]),
            0,
        );
        const room = board.parentElement.clientWidth - edges,
            ratio = window.devicePixelRatio || 1;
        const tall = Math.max(320, window.innerHeight - 260);
        const most = Math.max(
            1,
            Math.floor(Math.min((room * ratio) / this.image.width, (tall * ratio) / this.image.height)),
        );
        const fits = Math.max(1, Math.floor((room * ratio) / this.image.width));
        this.factor = this.wanted > 0 ? Math.min(this.wanted * Math.round(ratio), fits) : most;
        this.canvas.style.width = `${(this.image.width * this.factor) / ratio}px`;
        this.rule(this.rows);
    }

    /** Marks beside the picture, one a strip. */
    rule(rows) {
        this.rows = rows;
        const ruler = id('ruler'),
            glass = this.canvas,
            height = glass.clientHeight;
        if (!rows || !height || !this.image) return;
        const strips = Math.ceil(this.image.height / rows);
        ruler.style.top = `${glass.offsetTop + glass.parentElement.offsetTop}px`;
        ruler.style.height = `${height}px`;
        const each = (height * rows) / this.image.height;
        ruler.replaceChildren(
            ...(each < 3
                ? []
                : Array.from({ length: strips + 1 }, (_, i) =>
                      make('i', { style: `top:${Math.min(height, each * i)}px` }),
                  )),
        );
    }

    /** The picture once more, strip by strip, as it goes to the panel. */
    async playStrips() {
        const over = id('strips'),
            { width, height } = this.image,
            rows = Math.max(1, this.rows || height);
        const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
        over.width = width;
        over.height = height;
        over.style.width = this.canvas.style.width;
        over.hidden = false;
        const c = over.getContext('2d'),
            strips = Math.ceil(height / rows),
            wait = still ? 0 : between(1800 / strips, 16, 250);
        for (let i = 0; i <= strips; i++) {
            c.clearRect(0, 0, width, height);
            c.fillStyle = '#000';
            c.fillRect(0, i * rows, width, height);
            c.fillStyle = '#d9ab57';
            if (i < strips) c.fillRect(0, Math.min(height, (i + 1) * rows) - 1, width, 1);
            if (i < strips) c.fillRect(0, i * rows, width, 1);
            await new Promise((go) => setTimeout(go, wait));
        }
        over.hidden = true;
    }
}
