/* The board as a worker, so that the page goes on while it runs.
 *
 * In:  {image, symbols}: start with it; {}: the next picture. Out, of each: {words, cycles, ns}, or {error}.
 *
 * SPDX-License-Identifier: MIT
 */
import { Board } from './board.js';

let board = null;
self.onmessage = ({ data }) => {
    try {
        if (data.image) {
            board = new Board(data.image, data.symbols);
            board.patch('show_test', 0, 0x7fffffff); /* frame after frame, without regard to the clock */
            board.patch('show_test', 1, 1);
        }
        const got = board.picture();
        self.postMessage(got, [got.words.buffer]);
    } catch (e) {
        self.postMessage({ error: e.message });
    }
};
