/* A headless Chromium, spoken to by its own protocol over a pipe: no package is needed for that.
 *
 * SPDX-License-Identifier: MIT
 */
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const PATIENCE_MS = 120000; /* for whatever is waited for, on a machine that does other things too */

export class Browser {
    /** Start it. program: its name or path. */
    static async start(program) {
        const b = new Browser();
        b.folder = mkdtempSync(join(tmpdir(), 'zstrip-web-'));
        b.process = spawn(
            program,
            [
                '--headless=new',
                '--no-sandbox',
                '--disable-gpu',
                '--hide-scrollbars',
                '--mute-audio',
                '--disable-dev-shm-usage',
                '--disable-extensions',
                '--disable-background-networking',
                '--disable-component-update',
                '--no-first-run',
                '--disable-sync',
                '--force-color-profile=srgb',
                `--user-data-dir=${b.folder}`,
                '--remote-debugging-pipe',
                'about:blank',
            ],
            { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] },
        );
        b.calls = new Map();
        b.listeners = [];
        b.number = 0;
        b.ended = new Promise((done) => b.process.once('exit', done));
        b.process.once('error', (e) => b.fail(e));
        b.process.once('exit', () => b.fail(new Error('the browser has ended')));
        let rest = '';
        b.process.stdio[4].setEncoding('utf8');
        b.process.stdio[4].on('data', (text) => {
            const lines = (rest + text).split('\0');
            rest = lines.pop();
            for (const line of lines) b.hear(JSON.parse(line));
        });
        b.process.stdio[3].on('error', () => {});
        return b;
    }

    fail(error) {
        for (const { no } of this.calls.values()) no(error);
        this.calls.clear();
        this.dead = error;
    }

    hear(message) {
        const call = this.calls.get(message.id);
        if (call) {
            this.calls.delete(message.id);
            if (message.error) call.no(new Error(`${call.method}: ${message.error.message}`));
            else call.yes(message.result);
        } else {
            for (const listen of this.listeners) listen(message);
        }
    }

    send(method, params = {}, sessionId = undefined) {
        if (this.dead) return Promise.reject(this.dead);
        const id = ++this.number;
        return new Promise((yes, no) => {
            this.calls.set(id, { yes, no, method });
            this.process.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
        });
    }

    /** A new page of that size. dark: the colour scheme that is preferred. */
    async page({ width = 1280, height = 900, scale = 1, dark = false, touch = false } = {}) {
        const { targetId } = await this.send('Target.createTarget', { url: 'about:blank' });
        const { sessionId } = await this.send('Target.attachToTarget', { targetId, flatten: true });
        const page = new Page(this, sessionId, targetId);
        for (const domain of ['Page', 'Runtime', 'Network', 'Log', 'DOM']) await page.send(`${domain}.enable`);
        await page.send('Emulation.setDeviceMetricsOverride', {
            width,
            height,
            deviceScaleFactor: scale,
            mobile: touch,
        });
        await page.send('Emulation.setEmulatedMedia', {
            features: [{ name: 'prefers-color-scheme', value: dark ? 'dark' : 'light' }],
        });
        return page;
    }

    async stop() {
        await this.send('Browser.close').catch(() => {});
        await this.ended;
        rmSync(this.folder, { recursive: true, force: true, maxRetries: 5 });
    }
}

class Page {
    constructor(browser, sessionId, targetId) {
        this.browser = browser;
        this.sessionId = sessionId;
        this.targetId = targetId;
        this.errors = []; /* of the console, and exceptions that nobody caught */
        this.requests = []; /* addresses */
        browser.listeners.push((m) => m.sessionId === sessionId && this.hear(m));
    }

    send(method, params) {
        return this.browser.send(method, params, this.sessionId);
    }

    hear({ method, params }) {
        if (method === 'Runtime.exceptionThrown')
            this.errors.push(params.exceptionDetails.exception?.description || params.exceptionDetails.text);
        if (method === 'Runtime.consoleAPICalled' && /error|warning|assert/.test(params.type))
            this.errors.push(params.args.map((a) => a.value ?? a.description).join(' '));
        if (method === 'Log.entryAdded' && /error|warning/.test(params.entry.level))
            this.errors.push(params.entry.text);
        if (method === 'Network.requestWillBeSent') this.requests.push(params.request.url);
    }

    open(url) {
        return this.send('Page.navigate', { url });
    }

    /** The value of an expression; a promise is waited for. */
    async value(expression) {
        const got = await this.send('Runtime.evaluate', { expression, awaitPromise: true, returnByValue: true });
        if (got.exceptionDetails)
            throw new Error(
                `${expression}: ${got.exceptionDetails.exception?.description || got.exceptionDetails.text}`,
            );
        return got.result.value;
    }

    /** Wait until an expression is true. */
    async until(expression, what = expression) {
        const due = Date.now() + PATIENCE_MS;
        while (!(await this.value(expression).catch(() => false))) {
            if (Date.now() > due) throw new Error(`waited in vain for: ${what}`);
            await new Promise((go) => setTimeout(go, 20));
        }
    }

    /** Hand files to the page's file picker. */
    async pick(selector, files) {
        const { root } = await this.send('DOM.getDocument');
        const { nodeId } = await this.send('DOM.querySelector', { nodeId: root.nodeId, selector });
        await this.send('DOM.setFileInputFiles', { nodeId, files });
    }

    async key(key, code = key) {
        const text = key.length === 1 ? key : undefined;
        await this.send('Input.dispatchKeyEvent', {
            type: text ? 'keyDown' : 'rawKeyDown',
            key,
            code,
            text,
            windowsVirtualKeyCode: { Tab: 9, ArrowLeft: 37, ArrowRight: 39, ArrowUp: 38, ArrowDown: 40, Enter: 13 }[
                key
            ],
        });
        await this.send('Input.dispatchKeyEvent', { type: 'keyUp', key, code });
    }

    /** PNG of the window, or of all of the page. */
    async picture(whole = false) {
        const size = whole ? (await this.send('Page.getLayoutMetrics')).cssContentSize : null;
        const clip = size ? { x: 0, y: 0, width: size.width, height: size.height, scale: 1 } : undefined;
        const { data } = await this.send('Page.captureScreenshot', {
            format: 'png',
            clip,
            captureBeyondViewport: whole,
        });
        return Buffer.from(data, 'base64');
    }
}
