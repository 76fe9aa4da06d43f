// Mutants of firmware/zstrip: one operator, constant or condition of the renderer is changed, it is built for the host,
// and the unit tests of `make test` run until one fails. A mutant that none notices shows a test that is missing, or
// code that does not matter.
// Usage: node tests/mutate/mutate.mjs BUILD COUNT SEED [FILE...]   only mutants of these files
//
// The sample: each place that could be changed has a rank drawn from SEED, the file's name and the line's text, so that
// most of a sample stays the same when other lines change. Mutants that do not compile, and those whose object code is
// that of the program itself, are passed over and counted. All are run without sanitizers, which catches most and is
// quick; then what lived, unless it is known to change no outcome, under ASan and UBSan as in `make test`. Failing is:
// another exit status, or five times as long.
//
// BUILD/mutate/results.txt is added to while it runs: call it again, and it goes on. A line counts for as long as its
// file and the tests have the same text. At the end BUILD/mutate/report.txt is written, with the reasons that
// tests/MUTATION.txt gives for the same survivors.
//
// SPDX-License-Identifier: MIT
import { createHash } from 'node:crypto';
import { spawn, spawnSync } from 'node:child_process';
import * as fs from 'node:fs';
import * as path from 'node:path';

const [build, countText, seed, ...only] = process.argv.slice(2);
const COUNT = Number(countText);
const PLAIN_ONLY = process.env.MUTATE_PLAIN === '1'; // leave the second round out
const JOBS = Number(process.env.MUTATE_JOBS || 1);
const FROM = 'firmware/zstrip';
const REPORT = 'tests/MUTATION.txt';
const dir = path.join(build, 'mutate');
const resultsFile = path.join(dir, 'results.txt');
const sha = (text) => createHash('sha256').update(text).digest('hex');

// ---- Places -------------------------------------------------------------------------------------

const PAIRS = {
    '+': ['-'], '-': ['+'], '*': ['+'], '/': ['*'], '%': ['*'], '<<': ['>>'], '>>': ['<<'], '&': ['|'], '|': ['&'],
    '^': ['|'], '&&': ['||'], '||': ['&&'], '==': ['!='], '!=': ['=='], '<': ['<=', '>='], '>': ['>=', '<='],
    '<=': ['<', '>'], '>=': ['>', '<'], '+=': ['-='], '-=': ['+='], '<<=': ['>>='], '>>=': ['<<='], '&=': ['|='],
    '|=': ['&='], '^=': ['|='], '++': ['--'], '--': ['++'],
};
const UNARY = new Set(['-', '~', '!']);
const TOKEN = new RegExp([
    String.raw`(?<skip>\/\*[\s\S]*?\*\/|\/\/[^\n]*|"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*')`,
    String.raw`(?<define>^[ \t]*#[ \t]*define[ \t]+\w+(?:\([^)]*\))?)`,
    String.raw`(?<line>^[ \t]*#(?:[^\n\\]|\\[\s\S])*)`,
    String.raw`(?<word>[A-Za-z_]\w*)`,
    String.raw`(?<number>(?:0[xX][0-9a-fA-F]+|\d+)[uUlL]*)`,
    String.raw`(?<op><<=|>>=|->|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||[-+*\/%&|^]=|[-+*\/%&|^<>!~=?:;,.(){}[\]])`,
].join('|'), 'gm');
const NOT_HERE = new Set(['_Static_assert', '__asm__', '__attribute__']); // up to the closing bracket

function tokens(text) {
    const out = [];
    for (const m of text.matchAll(TOKEN)) {
        const kind = Object.keys(m.groups).find((k) => m.groups[k] !== undefined);
        if (kind !== 'skip' && kind !== 'line')
            out.push({ kind, text: m[0], at: m.index });
    }
    return out;
}

function closing(toks, open) {
    for (let i = open, depth = 0; i < toks.length; i++) {
        depth += toks[i].text === '(' ? 1 : toks[i].text === ')' ? -1 : 0;
        if (depth === 0)
            return i;
    }
    return toks.length - 1;
}

const TYPE = /^(const|struct|unsigned|int|long|char|u?int\d+_t|q\d+_\d+|zs_[a-z0-9_]+|uintptr_t|size_t|\*)$/;
function isCast(toks, close) {
    let i = close - 1;
    while (i >= 0 && TYPE.test(toks[i].text))
        i--;
    return i >= 0 && i < close - 1 && toks[i].text === '(';
}

// Every mutant of a file: { file, at, end, to, what }.
function placesOf(file, text) {
    const toks = tokens(text), out = [];
    const add = (at, end, to, what) => out.push({ file, at, end, to, what });
    for (let i = 0; i < toks.length; i++) {
        const t = toks[i], end = t.at + t.text.length;
        if (t.kind === 'word' && NOT_HERE.has(t.text)) {
            i = closing(toks, i + 1);
            continue;
        }
        if (t.kind === 'number') {
            const [, digits, suffix] = /^(0[xX][0-9a-fA-F]+|\d+)([uUlL]*)$/.exec(t.text);
            const hex = /^0[xX]/.test(digits), n = BigInt(digits);
            const spell = (v) => (hex ? '0x' + v.toString(16) : v.toString()) + suffix;
            add(t.at, end, spell(n + 1n), `${t.text} -> ${spell(n + 1n)}`);
            if (n > 0n)
                add(t.at, end, spell(n - 1n), `${t.text} -> ${spell(n - 1n)}`);
            continue;
        }
        if (t.kind === 'word' && t.text === 'if' && toks[i + 1].text === '(') {
            const close = toks[closing(toks, i + 1)], open = toks[i + 1].at;
            const condition = text.slice(open, close.at + 1);
            add(open, close.at + 1, `(!${condition})`, 'if (c) -> if (!c)');
            add(open, close.at + 1, `(${condition} && 0)`, 'if (c) -> if (0)');
            add(open, close.at + 1, `(${condition} || 1)`, 'if (c) -> if (1)');
            continue;
        }
        if (t.kind !== 'op')
            continue;
        const before = toks[i - 1];
        const binary = before && (before.kind === 'number' || before.text === ']' ||
            (before.kind === 'word' && before.text !== 'return') || (before.text === ')' && !isCast(toks, i - 1)));
        if (UNARY.has(t.text) && !binary)
            add(t.at, end, '', `unary ${t.text} left out`);
        else if (t.text in PAIRS && (binary || t.text === '++' || t.text === '--'))
            for (const to of PAIRS[t.text])
                add(t.at, end, to, `${t.text} -> ${to}`);
    }
    return out;
}

// ---- The sample ---------------------------------------------------------------------------------

const sources = fs.readdirSync(FROM).filter((f) => /\.[ch]$/.test(f)).sort();
const textOf = Object.fromEntries(sources.map((f) => [f, fs.readFileSync(path.join(FROM, f), 'utf8')]));
const testsSha = sha(fs.readdirSync('tests').filter((f) => /\.[ch]$/.test(f)).sort()
    .map((f) => fs.readFileSync('tests/' + f, 'utf8')).join('\n')).slice(0, 12);

function sample() {
    const places = new Map(); // by place: one of its mutants is drawn
    for (const file of sources) {
        if (only.length && !only.includes(file))
            continue;
        const text = textOf[file], seen = new Map();
        for (const m of placesOf(file, text)) {
            const from = text.lastIndexOf('\n', m.at - 1) + 1;
            const line = text.slice(from, text.indexOf('\n', m.at)).replace(/\s*\/\*.*$/, '');
            m.line = text.slice(0, m.at).split('\n').length;
            m.code = line.trim();
            m.column = m.at - from - (line.length - line.trimStart().length) + 1;
            const name = `${file}|${m.code}|${m.column}`;
            const times = seen.get(name) || new Map(); // the same line twice in a file: by its turn
            seen.set(name, times);
            if (!times.has(m.line))
                times.set(m.line, times.size);
            const place = `${name}|${times.get(m.line)}`;
            m.key = `${place}|${m.what}`;
            m.rank = sha(`${seed}|${m.key}`);
            const best = places.get(place);
            if (!best || m.rank < best.rank)
                places.set(place, m);
        }
    }
    return [...places.values()].sort((a, b) => (sha(`${seed}|${a.rank}`) < sha(`${seed}|${b.rank}`) ? -1 : 1));
}

// ---- Building and running -----------------------------------------------------------------------

const lines = (text) => text.split('\n').filter(Boolean);
// From make, so that this cannot differ from `make test`: what compiles an object, and what links a test
function stage(name, at, ...variables) {
    const make = spawnSync('make', ['-s', 'mutate-settings', `B=${at}`, ...variables], { encoding: 'utf8' });
    const set = Object.fromEntries(lines(make.stdout).map((l) => [l.slice(0, l.indexOf(' ')), l.slice(l.indexOf(' ') + 1)]));
    return { name, at: path.join(at, 'test'), cc: set.cc, link: set.link, tests: set.tests.split(' '),
        help: set.sources.split(' ') };
}
const STAGES = [stage('plain', path.join(dir, 'plain'), 'SAN='), stage('sanitized', build)];
const TESTS = STAGES[0].tests;

function run(command, options = {}) { // { status, ms }; its own process group, so that a test's children end with it
    return new Promise((resolve) => {
        const start = process.hrtime.bigint();
        const child = spawn('sh', ['-c', 'exec ' + command], { detached: true, stdio: ['ignore', 'pipe', 'ignore'],
            env: { ...process.env, ASAN_OPTIONS: 'detect_leaks=0', LC_ALL: 'C' } });
        let text = '', late = false, bad = false;
        const end = () => {
            try {
                process.kill(-child.pid, 'SIGKILL');
            } catch { /* it has ended */ }
        };
        const timer = setTimeout(() => {
            late = true;
            end();
        }, options.limit || 600000);
        child.stdout.on('data', (d) => {
            text = (text + d).slice(-4000);
            if (options.test && !bad && /\[  FAILED  \]|^FAILED/m.test(text)) { // cmocka goes on: we need not
                bad = true;
                end();
            }
        });
        child.on('close', (status) => {
            clearTimeout(timer);
            resolve({ status: bad ? 1 : late ? 'late' : status === null ? 'signal' : status,
                ms: Number((process.hrtime.bigint() - start) / 1000000n) });
        });
    });
}

const includes = {}; // FILE: headers of firmware/zstrip that it includes, in any depth
function headersOf(file) {
    if (!includes[file]) {
        const out = spawnSync('sh', ['-c', `${STAGES[0].cc} -MM ${file}`], { encoding: 'utf8' }).stdout;
        includes[file] = new Set([...out.matchAll(/firmware\/zstrip\/(\w+\.h)/g)].map((m) => m[1]));
    }
    return includes[file];
}

// The object of a file, where the mutant changes it: '' where not, null where it does not compile.
async function compile(m, stage, work, file) {
    const mine = file.startsWith(FROM);
    if (m.file.endsWith('.c') ? file !== `${FROM}/${m.file}` : !headersOf(file).has(m.file))
        return '';
    const src = path.join(work, 'zstrip');
    const o = path.join(work, stage.name, file.replace(/\.c$/, '.o'));
    fs.mkdirSync(path.dirname(o), { recursive: true });
    const cc = stage.cc.replace('-Ifirmware/zstrip', `-I${src}`).replace('-Werror', '');
    const r = await run(`${cc} -w -g0 -c ${mine ? path.join(src, path.basename(file)) : file} -o ${o} 2>/dev/null`);
    return r.status === 0 ? o : null;
}

async function compileAll(m, stage, work, files) {
    const out = [];
    for (const file of files) {
        const o = await compile(m, stage, work, file);
        if (o === null)
            return null;
        if (o)
            out.push(o);
    }
    return out;
}

const bytes = (files) => sha(Buffer.concat(files.map((f) => fs.readFileSync(f))));

const timing = {}; // STAGE/TEST: ms of the program itself, and how many mutants it has caught
async function measure(stage) {
    for (const test of TESTS) {
        const r = await run(`${path.join(stage.at, test)}`, { test: true });
        if (r.status !== 0)
            throw new Error(`${stage.name}/${test} does not pass without a mutant: ${r.status}`);
        timing[`${stage.name}/${test}`] = { ms: r.ms, caught: 0 };
    }
}

function order(stage, file) { // most likely to catch a mutant of this file, by the second
    const worth = (t) => {
        const { ms, caught } = timing[`${stage.name}/${t}`];
        return (1 + caught + 4 * (caughtIn[`${file}/${t}`] || 0)) / (ms + 150);
    };
    return [...TESTS].sort((a, b) => worth(b) - worth(a));
}
const caughtIn = {};

const CORE = sources.filter((f) => f.endsWith('.c')).map((f) => `${FROM}/${f}`);
async function tried(m, work, stage) {
    const src = path.join(work, 'zstrip'), text = textOf[m.file];
    fs.rmSync(work, { recursive: true, force: true });
    fs.cpSync(path.join(dir, 'zstrip'), src, { recursive: true });
    const before = await compileAll(m, stage, work, CORE);
    if (!before || !before.length)
        throw new Error(`${m.file} does not compile`);
    const same = bytes(before);
    fs.writeFileSync(path.join(src, m.file), text.slice(0, m.at) + m.to + text.slice(m.end));
    const core = await compileAll(m, stage, work, CORE);
    const help = core && await compileAll(m, stage, work, stage.help);
    if (!help)
        return 'invalid -';
    if (stage === STAGES[0] && bytes(core) === same)
        return 'same -';
    for (const test of order(stage, m.file)) {
        const own = await compile(m, stage, work, `tests/${test}.c`);
        if (own === null)
            return 'invalid -';
        const exe = path.join(work, test);
        const objects = [own || path.join(stage.at, 'tests', test + '.o'), ...core, ...help];
        // what the mutant has changed takes the place of the stage's own
        const mine = help.map((o) => o.slice(`${work}/${stage.name}/`.length));
        const link = stage.link.split(' ').filter((w) => !mine.some((o) => w.endsWith(o))).join(' ')
            .replace('OBJECTS', objects.join(' ')).replace('OUT', exe);
        const linked = await run(`${link} 2>${work}/link.txt`);
        if (linked.status !== 0)
            throw new Error(`${test} does not link: ${fs.readFileSync(`${work}/link.txt`, 'utf8')}`);
        const time = timing[`${stage.name}/${test}`];
        const r = await run(exe, { test: true, limit: 5 * time.ms + 3000 });
        fs.rmSync(exe);
        if (r.status !== 0) {
            time.caught++;
            caughtIn[`${m.file}/${test}`] = (caughtIn[`${m.file}/${test}`] || 0) + 1;
            return `caught ${stage === STAGES[0] ? '' : 'sanitized/'}${test}${r.status === 'late' ? ',late' : ''}`;
        }
    }
    return `${stage === STAGES[0] ? 'lives' : 'survived'} -`;
}

// ---- What is known, and the report --------------------------------------------------------------

const fileSha = Object.fromEntries(sources.map((f) => [f, sha(textOf[f]).slice(0, 12)]));
const id = (m) => sha(`${seed}|${m.key}`).slice(0, 16);
const known = new Map(); // ID FILE'S SHA: VERDICT BY TESTS' SHA, the last that was found
if (fs.existsSync(resultsFile))
    for (const line of lines(fs.readFileSync(resultsFile, 'utf8'))) {
        const [i, file, tests, verdict, by] = line.split(' ');
        known.set(`${i} ${file}`, { verdict: `${verdict} ${by}`, tests });
    }
function verdictOf(m) { // what survived is asked again where tests have changed
    const k = known.get(`${id(m)} ${fileSha[m.file]}`);
    return k && (/^(caught|same|invalid)/.test(k.verdict) || k.tests === testsSha) ? k.verdict : null;
}
function record(m, verdict) {
    fs.appendFileSync(resultsFile, `${id(m)} ${fileSha[m.file]} ${testsSha} ${verdict} ${m.file}:${m.line} ${m.what}\n`);
}

function reasons() { // "FILE: CODE: WHAT (column N)" of tests/MUTATION.txt, and the indented lines below it
    const out = new Map();
    if (!fs.existsSync(REPORT))
        return out;
    let at = null;
    for (const line of fs.readFileSync(REPORT, 'utf8').split('\n')) {
        const m = /^([a-z_0-9]+\.[ch])(?::\d+)?: (.*)$/.exec(line);
        if (m)
            out.set(at = `${m[1]}: ${m[2]}`, []);
        else if (at && /^ {4}\S/.test(line))
            out.get(at).push(line);
        else
            at = null;
    }
    return out;
}

const why = reasons();
const reasonOf = (m) => why.get(`${m.file}: ${title(m)}`) || [];
const harmless = (m) => /^ {4}(equivalent|speed)/.test(reasonOf(m)[0] || '');
const title = (m) => `${m.code}  [${m.what}, column ${m.column}]`;
function report(done, passed) {
    const by = {}, files = {};
    let caught = 0;
    for (const { m, verdict } of done) {
        const [what, test] = verdict.split(' ');
        const f = (files[m.file] ||= { n: 0, caught: 0 });
        f.n++;
        if (what === 'caught') {
            caught++;
            f.caught++;
            const name = test.replace(/^sanitized\//, '').replace(/,late$/, '');
            by[name] = (by[name] || 0) + 1;
        }
    }
    const survivors = done.filter((d) => /^(survived|lives)/.test(d.verdict));
    const same = survivors.filter((d) => harmless(d.m)).length;
    const percent = (n, d) => (d ? (100 * n / d).toFixed(1) : '0.0');
    const out = [];
    out.push(`Mutants of firmware/zstrip: seed ${seed}, ${done.length} built and run, ${caught} caught ` +
        `(${percent(caught, done.length)} %), ${survivors.length} survived.`);
    out.push(`Of the survivors ${same} change no outcome (equivalent, or only speed): of those that do, ` +
        `${percent(caught, done.length - same)} % are caught.`);
    out.push(`Passed over: ${passed.invalid} that do not compile, ${passed.same} with the same object code.`, '');
    out.push('file                 mutants  caught');
    for (const [f, v] of Object.entries(files).sort())
        out.push(`${f.padEnd(20)} ${String(v.n).padStart(7)} ${String(v.caught).padStart(7)}`);
    out.push('', 'caught by (the first that fails; the order is by what has caught most a second)');
    for (const [t, n] of Object.entries(by).sort((a, b) => b[1] - a[1]))
        out.push(`${t.padEnd(20)} ${String(n).padStart(7)}`);
    out.push('', 'Survivors');
    for (const { m } of survivors.sort((a, b) => (a.m.file + a.m.line.toString().padStart(6) <
        b.m.file + b.m.line.toString().padStart(6) ? -1 : 1))) {
        out.push('', `${m.file}:${m.line}: ${title(m)}`);
        out.push(...(reasonOf(m).length ? reasonOf(m) : ['    not explained']));
    }
    fs.writeFileSync(path.join(dir, 'report.txt'), out.join('\n') + '\n');
    console.log(out.join('\n'));
    const open = survivors.filter((d) => !reasonOf(d.m).length).length;
    console.log(open ? `${open} survivors are not explained in ${REPORT}` : 'every survivor is explained');
}

// ---- All of it ----------------------------------------------------------------------------------

fs.mkdirSync(dir, { recursive: true });
fs.rmSync(path.join(dir, 'zstrip'), { recursive: true, force: true });
fs.cpSync(FROM, path.join(dir, 'zstrip'), { recursive: true }); // the files may change while this runs
const queue = sample(), done = [], passed = { same: 0, invalid: 0 };
console.log(`${queue.length} places of ${only.length ? only.join(' ') : FROM}`);

async function round(stage, list, enough) { // each of the list until enough() says so
    let next = 0, measured = null;
    async function worker(number) {
        const work = path.join(dir, `work${number}`);
        while (next < list.length && !enough()) {
            const d = list[next++];
            if (!d.verdict) {
                await (measured ||= measure(stage));
                const start = Date.now();
                d.verdict = await tried(d.m, work, stage);
                record(d.m, d.verdict);
                if (!/^(same|invalid)/.test(d.verdict))
                    console.log(`${done.length + 1} ${((Date.now() - start) / 1000).toFixed(1)} s ${d.verdict}: ` +
                        `${d.m.file}:${d.m.line}: ${title(d.m)}`);
            }
            const what = d.verdict.split(' ')[0];
            if (stage === STAGES[0] && what in passed)
                passed[what]++;
            else if (stage === STAGES[0])
                done.push(d);
        }
    }
    await Promise.all([...Array(JOBS).keys()].map(worker));
}
await round(STAGES[0], queue.map((m) => ({ m, verdict: verdictOf(m) })), () => done.length >= COUNT);
const lives = done.filter((d) => d.verdict.startsWith('lives') && !harmless(d.m));
if (!PLAIN_ONLY) {
    for (const d of lives)
        d.verdict = null;
    await round(STAGES[1], lives, () => false);
}
report(done, passed);
