// Mutants of firmware/zstrip: one operator, constant or condition of the renderer is changed, it is built for the host,
// and the cases of `make test`'s unit tests run until one fails. A mutant that none notices shows a test that is
// missing, or code that does not matter.
// Usage: node tests/lab/mutate/mutate.mjs BUILD COUNT SEED [FILE...]   only mutants of these files
//
// The sample: each place that could be changed has a rank drawn from SEED, the file's name and the line's text, so that
// most of a sample stays the same when other lines change. What the mutant changes is compiled like in `make test`
// (-O1, preconditions checked), under UBSan that traps; the rest without sanitizers. All test programs are one
// (runner.c): a link a mutant, a process a case, those first that catch most a second. Failing is: another exit status,
// a signal, or five times as long.
// Passed over and counted apart: mutants that do not compile, and those whose object code is that of the program
// itself, as compiled for the tests or, where no test notices, as shipped (-O2, preconditions not checked).
//
// BUILD/mutate/results.txt is added to while it runs: call it again, and it goes on. A line counts for as long as its
// file and, of a mutant that lived, the tests have the same text. At the end BUILD/mutate/report.txt is written, with
// the reasons that tests/records/MUTATION.txt gives for the same survivors.
//
// SPDX-License-Identifier: MIT
import { createHash } from 'node:crypto';
import { spawnSync } from 'node:child_process';
import * as fs from 'node:fs';
import * as path from 'node:path';

const [build, countText, seed, ...only] = process.argv.slice(2);
const COUNT = Number(countText);
const PART = Number(process.env.MUTATE_PART || -1); // 0, 1: one half of the sample, beside the other; then once without
const KNOWN = process.env.MUTATE_KNOWN === '1'; // none that has not been run before: a report of a part
const FROM = 'firmware/zstrip';
const REPORT = 'tests/records/MUTATION.txt';
const dir = path.join(build, 'mutate');
const COPY = path.join(dir, `zstrip${PART}`);
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

const sources = fs.readdirSync(FROM, { recursive: true }).filter((f) => /\.[ch]$/.test(f)).sort();
const textOf = Object.fromEntries(sources.map((f) => [f, fs.readFileSync(path.join(FROM, f), 'utf8')]));
const testsSha = sha(['unit', 'property', 'lib'].flatMap((d) => fs.readdirSync(`tests/${d}`)
    .filter((f) => /\.[ch]$/.test(f)).sort().map((f) => fs.readFileSync(`tests/${d}/${f}`, 'utf8')))
    .join('\n')).slice(0, 12);

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
const make = spawnSync('make', ['-s', 'mutate-settings', `B=${build}/mutate/plain`, 'SAN='], { encoding: 'utf8' });
const setting = (l) => [l.slice(0, l.indexOf(' ')), l.slice(l.indexOf(' ') + 1)]; // NAME VALUE
const set = Object.fromEntries(lines(make.stdout).map(setting));
const TESTS = set.tests.split(' '), HELP = set.sources.split(' ');
const CORE = sources.filter((f) => f.endsWith('.c')).map((f) => `${FROM}/${f}`);
const OWN = set.files.split(' '); // tests/FOLDER/TEST.c
const fileOf = Object.fromEntries(OWN.map((f) => [path.basename(f, '.c'), f]));
const base = path.join(dir, `base${PART}`), plain = path.join(dir, 'plain', 'test');
const TRAPS = '-fsanitize=undefined -fsanitize-undefined-trap-on-error';
const AS_SHIPPED = `${set.cc.replace(/ -O1 .*? -I/, ' -O2 -I').replace(/ -DZS_STATS=1.*/, ' -DZS_STATS=1')}`;

function sh(command, input) {
    const r = spawnSync('sh', ['-c', command], { encoding: 'utf8', input, maxBuffer: 1 << 28,
        env: { ...process.env, LC_ALL: 'C' } });
    return { status: r.status, out: r.stdout, err: r.stderr };
}
function must(command) {
    const r = sh(command);
    if (r.status !== 0)
        throw new Error(`${command}\n${r.err}`);
    return r.out;
}

const objectOf = (at, file) => path.join(at, file.replace(/\.c$/, '.o'));
// Object of a file with the renderer's sources in src; null where it does not compile.
function compile(cc, file, src, at) {
    const o = objectOf(at, file), mine = file.startsWith(FROM + '/');
    fs.mkdirSync(path.dirname(o), { recursive: true });
    const command = cc.replace(`-I${FROM}`, `-I${src}`).replace('-Werror', '');
    const from = mine ? path.join(src, path.relative(FROM, file)) : file;
    const r = sh(`${command} ${mine && cc === set.cc ? TRAPS : ''} -w -g0 -c ${from} -o ${o}`);
    return r.status === 0 ? o : null;
}
function renamed(test, from, to) { // its main becomes main_TEST
    fs.mkdirSync(path.dirname(to), { recursive: true });
    must(`objcopy --redefine-sym main=main_${test} ${from} ${to}`);
}

const includes = {}; // FILE: headers of firmware/zstrip that it includes, in any depth
function headersOf(file) {
    if (!includes[file]) {
        const out = sh(`${set.cc} -MM ${file}`).out;
        includes[file] = new Set([...out.matchAll(/firmware\/zstrip\/([\w/]+\.h)/g)].map((m) => m[1]));
    }
    return includes[file];
}
const changedBy = (m, files) => (m.file.endsWith('.c') ? files.filter((f) => f === `${FROM}/${m.file}`) :
    files.filter((f) => headersOf(f).has(m.file)));

const bytes = (file) => sha(fs.readFileSync(file));
const own = {}; // CC|FILE: of the program itself
function bytesOfOwn(cc, file) {
    const o = compile(cc, file, COPY, base + (cc === set.cc ? '' : '2'));
    return own[`${cc}|${file}`] ||= bytes(o);
}

function link(exe, files, at, more = '') { // the objects of these files, in `at`, take the place of the program's own
    const mine = files.map((f) => '/' + f.replace(/\.c$/, '.o'));
    const rest = set.link.split(' ').filter((w) => !mine.some((o) => w.endsWith(o))).join(' ');
    const tests = OWN.filter((f) => !files.includes(f)).map((f) => objectOf(`${plain}/mutate`, f));
    const objects = [`${plain}/mutate/runner.o`, ...tests, ...files.map((f) => objectOf(at, f))];
    must(rest.replace('OBJECTS', objects.join(' ')).replace('OUT', exe) + ' ' + more);
}

const textSha = (file) => sha(fs.readFileSync(file, 'utf8'));
const timing = new Map(); // CASE: ms of the program itself
function prepare() {
    const file = path.join(dir, 'timing.json');
    const known = fs.existsSync(file) ? JSON.parse(fs.readFileSync(file, 'utf8')) : {};
    const core = sha(sources.map((f) => textOf[f]).join(''));
    const due = TESTS.filter((t) => known[t]?.of !== core + textSha(fileOf[t]));
    for (const t of due)
        known[t] = { of: core + textSha(fileOf[t]), ms: {} };
    for (const line of due.length ? lines(must(`${plain}/mutate/runner measure ${due.join(' ')}`)) : []) {
        const [name, status, ms] = line.split(' ');
        if (status !== '0')
            throw new Error(`${name} does not pass without a mutant: ${status}`);
        known[name.split('/')[0]].ms[name] = Number(ms);
    }
    fs.writeFileSync(file, JSON.stringify(known));
    for (const t of TESTS)
        for (const [name, ms] of Object.entries(known[t].ms))
            timing.set(name, ms);
    cover();
}

// CASE: the lines FILE:LINE of the renderer that it reaches; and all that some case reaches, or none. Found once: what
// is of a file or a test that has changed since is not relied on (remove BUILD/mutate/cover.json to find it anew).
const reaches = new Map(), counted = new Set();
function cover() {
    const at = path.join(process.cwd(), dir, 'cover'), known = path.join(dir, 'cover.json');
    if (!fs.existsSync(known)) {
        const cases = [...timing.keys()], lines = {}, all = new Set();
        fs.rmSync(at, { recursive: true, force: true });
        for (const f of CORE)
            compile(set.cc + ' --coverage -fprofile-update=prefer-atomic', f, COPY, at);
        link(`${at}/runner`, CORE, at, '--coverage');
        must(`${at}/runner cover ${at}/of`);
        cases.forEach((name, n) => {
            const from = `${at}/of/${n}${at}/${FROM}`, reached = lines[name] = [];
            if (!fs.existsSync(from))
                return;
            const copied = `cd ${at}/${FROM} && find . -name "*.gcno" | cpio -pd --quiet ${from}`;
            const out = must(`cd ${from} && (${copied}) && ` +
                'gcov -t --json-format $(find . -name "*.gcda") 2>/dev/null');
            for (const text of out.split('\n').filter((l) => l.startsWith('{')))
                for (const { file, lines: of } of JSON.parse(text).files)
                    if (file.includes('/zstrip/'))
                        for (const l of of) {
                            all.add(`${file.replace(/.*\/zstrip\//, '')}:${l.line_number}`);
                            if (l.count > 0)
                                reached.push(`${file.replace(/.*\/zstrip\//, '')}:${l.line_number}`);
                        }
        });
        fs.rmSync(at, { recursive: true, force: true });
        const of = Object.fromEntries([...OWN.map((f) => [f, textSha(f)]), ...sources.map((f) => [f, sha(textOf[f])])]);
        fs.writeFileSync(known, JSON.stringify({ of, all: [...all], lines }));
    }
    const { of, all, lines } = JSON.parse(fs.readFileSync(known, 'utf8'));
    all.filter((l) => of[l.split(':')[0]] === sha(textOf[l.split(':')[0]] || '')).forEach((l) => counted.add(l));
    for (const [name, reached] of Object.entries(lines))
        if (of[fileOf[name.split('/')[0]]] === textSha(fileOf[name.split('/')[0]]))
            reaches.set(name, new Set(reached));
}

const caught = {}; // CASE, FILE/CASE: how many mutants it has caught
// Of the cases that reach it, those first that are most likely to catch a mutant of its file, by the second
function order(m) {
    const line = `${m.file}:${m.line}`;
    const worth = (t) => (0.3 + (caught[t] || 0) + 4 * (caught[`${m.file}/${t}`] || 0)) / (timing.get(t) + 20);
    return [...timing.keys()].filter((t) => !counted.has(line) || !reaches.get(t)?.size || reaches.get(t).has(line))
        .sort((a, b) => worth(b) - worth(a));
}
function count(file, test) {
    caught[test] = (caught[test] || 0) + 1;
    caught[`${file}/${test}`] = (caught[`${file}/${test}`] || 0) + 1;
}

function tried(m) {
    const work = path.join(dir, `work${PART}`), src = path.join(work, 'zstrip'), text = textOf[m.file];
    const files = changedBy(m, CORE);
    fs.rmSync(work, { recursive: true, force: true });
    fs.cpSync(COPY, src, { recursive: true });
    fs.writeFileSync(path.join(src, m.file), text.slice(0, m.at) + m.to + text.slice(m.end));
    const built = files.map((f) => compile(set.cc, f, src, work));
    if (!files.length || built.includes(null))
        return 'invalid -';
    if (files.every((f, i) => bytes(built[i]) === bytesOfOwn(set.cc, f)))
        return 'same -';
    const more = changedBy(m, [...HELP, ...OWN]);
    for (const f of more) {
        const o = compile(set.cc, f, src, work);
        if (o === null)
            return 'invalid -';
        if (OWN.includes(f)) {
            renamed(path.basename(f, '.c'), o, o + '.renamed');
            fs.renameSync(o + '.renamed', o);
        }
    }
    link(`${work}/runner`, [...files, ...more], work);
    const asked = order(m).map((t) => `${t} ${5 * timing.get(t) + 2000}\n`).join('');
    const r = sh(`${work}/runner first 2>/dev/null`, asked);
    if (r.status !== 0)
        throw new Error(`runner: status ${r.status}`);
    if (r.out) {
        const [test, late] = r.out.trim().split(' ');
        count(m.file, test);
        return `caught ${test}${late ? ',late' : ''}`;
    }
    const same = files.every((f) => {
        const o = compile(AS_SHIPPED, f, src, work + '/shipped');
        return o && bytes(o) === bytesOfOwn(AS_SHIPPED, f);
    });
    return same ? 'same shipped' : 'survived -';
}

// ---- What is known, and the report --------------------------------------------------------------

const fileSha = Object.fromEntries(sources.map((f) => [f, sha(textOf[f]).slice(0, 12)]));
const id = (m) => sha(`${seed}|${m.key}`).slice(0, 16);
const known = new Map(); // ID FILE'S SHA: VERDICT BY TESTS' SHA, the last that was found
if (fs.existsSync(resultsFile))
    for (const line of lines(fs.readFileSync(resultsFile, 'utf8'))) {
        const [i, file, tests, verdict, by] = line.split(' ');
        known.set(`${i} ${file}`, { verdict: `${verdict} ${by}`, tests });
        if (verdict === 'caught')
            count(line.split(' ')[5].split(':')[0], by.replace(/,late$/, ''));
    }
function verdictOf(m) { // what survived is asked again where tests have changed
    const k = known.get(`${id(m)} ${fileSha[m.file]}`);
    return k && (/^(caught|same|invalid)/.test(k.verdict) || k.tests === testsSha) ? k.verdict : null;
}
function record(m, verdict) {
    fs.appendFileSync(resultsFile,
        `${id(m)} ${fileSha[m.file]} ${testsSha} ${verdict} ${m.file}:${m.line} ${m.what}\n`);
}

function reasons() { // "FILE: CODE: WHAT (column N)" of tests/records/MUTATION.txt, and the indented lines below it
    const out = new Map();
    if (!fs.existsSync(REPORT))
        return out;
    let at = null;
    for (const line of fs.readFileSync(REPORT, 'utf8').split('\n')) {
        const m = /^([a-z_0-9/]+\.[ch])(?::\d+)?: (.*)$/.exec(line);
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
const explained = (m) => /^ {4}(equivalent|speed|margin)/.test(reasonOf(m)[0] || ''); // not run again
const title = (m) => `${m.code}  [${m.what}, column ${m.column}]`;
function report(done, passed) {
    const by = {}, files = {};
    let n = 0;
    for (const { m, verdict } of done) {
        const [what, test] = verdict.split(' ');
        const f = (files[m.file] ||= { n: 0, caught: 0 });
        f.n++;
        if (what === 'caught') {
            n++;
            f.caught++;
            const name = test.replace(/\/.*/, '');
            by[name] = (by[name] || 0) + 1;
        }
    }
    const survivors = done.filter((d) => d.verdict.startsWith('survived'));
    const same = survivors.filter((d) => harmless(d.m)).length;
    const percent = (n, d) => (d ? (100 * n / d).toFixed(1) : '0.0');
    const out = [];
    out.push(`Mutants of firmware/zstrip: seed ${seed}, ${done.length} built and run, ${n} caught ` +
        `(${percent(n, done.length)} %), ${survivors.length} survived.`);
    out.push(`Of the survivors ${same} change no outcome (equivalent, or only speed): of those that do, ` +
        `${percent(n, done.length - same)} % are caught.`);
    out.push(`Passed over: ${passed.invalid} that do not compile, ${passed.same} with the same object code.`, '');
    out.push('file                    mutants  caught');
    for (const [f, v] of Object.entries(files).sort())
        out.push(`${f.padEnd(23)} ${String(v.n).padStart(7)} ${String(v.caught).padStart(7)}`);
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
fs.mkdirSync(base, { recursive: true });
fs.rmSync(COPY, { recursive: true, force: true });
fs.cpSync(FROM, COPY, { recursive: true }); // the files may change while this runs
const queue = sample(), done = [], passed = { same: 0, invalid: 0 };
console.log(`${queue.length} places of ${only.length ? only.join(' ') : FROM}`);

const seen = (m) => known.has(`${id(m)} ${fileSha[m.file]}`);
const end = KNOWN ? queue.findLastIndex(seen) + 1 : queue.length;
for (const m of queue.slice(0, end).filter((_, n) => PART < 0 || n % 2 === PART)) {
    if (done.length >= (PART < 0 ? COUNT : COUNT / 2))
        break;
    let verdict = explained(m) ? 'survived explained' : verdictOf(m);
    if (!verdict && KNOWN && !seen(m))
        continue;
    if (!verdict) {
        if (!timing.size)
            prepare();
        const start = Date.now();
        verdict = tried(m);
        record(m, verdict);
        if (!/^(same|invalid)/.test(verdict))
            console.log(`${done.length + 1} ${((Date.now() - start) / 1000).toFixed(1)} s ${verdict}: ` +
                `${m.file}:${m.line}: ${title(m)}`);
    }
    const what = verdict.split(' ')[0];
    if (what in passed)
        passed[what]++;
    else
        done.push({ m, verdict });
}
report(done, passed);
