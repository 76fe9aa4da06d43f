// The worst case of the stack of folders' functions: no recursion, fixed frames, and where calls through pointers may
// go.
// Usage: node tests/checks/stack.mjs <LIST
// LIST has a line for each folder, words separated by blanks: NAME DIR LIMIT PREFIX OUTSIDE EMPTY [FUNCTION...]
//   NAME      what it is called in verdicts, _ in place of blanks
//   DIR       objects as tests/lib/cortexm.sh measures them, each with its .su, in which the compiler's call graph is
//             too, and all.elf, a program that has all of them. What is found goes to bound.txt there.
//   PREFIX    of the names of public functions
//   OUTSIDE   structs, or STRUCT.FIELDs, whose functions are the caller's, a,b,c: what they take comes on top
//   EMPTY     fields that nothing may stand in, as of this build they are never called: STRUCT.FIELD or how it begins,
//             a,b,c
//   FUNCTION  public functions whose bound is printed; the first one's deepest path too
//
// Frames are those of the compiler's call graph. Calls are its edges and, so that calls which it adds later
// (division, counting zeros, block moves) are in too, the relocations of each function's section. Helpers of libgcc and
// newlib, and frames of what is one piece of assembler, are measured on the program: every push and subtraction from sp
// in them, summed, and the deepest callee.
//
// Calls through pointers. The compiler gives the place of each; what is called there is an expression like
// job->fast->lit, whose type the debug information has: field `lit` of struct zs_fast, or a variable. It may hold
//   - what const tables have in that field of that struct: from their relocations, by offset;
//   - what is assigned to it anywhere in the source, or given as that argument of a function: functions by name, what
//     may be in another field or variable, what a function returns that returns such a pointer.
// A call whose place is not understood fails, as does a function whose address code takes and that is in no such place.
//
// SPDX-License-Identifier: MIT
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import * as fs from 'node:fs';
import * as os from 'node:os';
import * as path from 'node:path';

const ARM = process.env.ARM || 'arm-none-eabi-';
// What a tool says, by way of a file: 100 MB of lines, of which few become strings. All tools are asked before anything
// is read, each of all files at once: to begin takes them longer than an object, and node, once it is large, takes
// longer still to start them.
const scratch = fs.mkdtempSync(path.join(os.tmpdir(), 'stack-'));
process.on('exit', () => fs.rmSync(scratch, { recursive: true, force: true }));
let asked = 0;
function ask(tool, options, files) {
    const name = path.join(scratch, `said${asked++}`), to = fs.openSync(name, 'w');
    execFileSync(ARM + tool, [...options, ...files], { stdio: ['ignore', to, 'ignore'] });
    fs.closeSync(to);
    return name;
}

// Calls that are refused before a frame is drawn, so that a shader made of another one is never in itself:
// zs_layered_set takes no layer and no shader with a span of its own, zs_filtered_set neither those nor a filtered one
// (tests/unit/test_layered.c sees both).
const LAYERS = ['effect_layered:mix_run', 'effect_layered:add_run', 'effect_layered_door:door_run',
    'effect_blend:mix_run', 'effect_blend:add_run', 'effect_blend_over:mix_smooth', 'effect_blend_over:add_smooth',
    'effect_blend_over:mix_texture', 'effect_blend_over:add_texture', 'effect_stipple:solid_run',
    'effect_stipple:smooth_run', 'effect_stipple:texture_run', 'effect_cutout:cutout_run', 'effect_window:window_run',
    'effect_shadow_shade:shadow_run'];
const FILTERS = ['zs_filtered_run', 'effect_mipmap:filtered_run'];
const REFUSED = new Map([
    ['zs_layered_draw', LAYERS],
    ['zs_filtered_run', [...LAYERS, ...FILTERS]],
    ['effect_layered:start', ['effect_layered:start']],
    ['effect_filtered:start', ['effect_filtered:start', 'effect_layered:start']],
    ['effect_filtered:check', ['effect_filtered:check']]
]);

const add = (map, key, value) => {
    if (!map.has(key))
        map.set(key, new Set());
    map.get(key).add(value);
};

// ---- Debug information --------------------------------------------------------------------------

// Attributes that are asked for below
const ATTRIBUTES = new Set(['name', 'type', 'abstract_origin', 'specification', 'decl_line', 'decl_file',
    'data_member_location', 'byte_size']);
// Of these nothing is asked
const UNUSED = /call_site/;
const [NEWLINE, BLANK, LESS, COLON] = ['\n', ' ', '<', ':'].map((c) => c.charCodeAt(0));

// Entries by their offset: tag, attributes by name, entries in them. Of an entry readelf says " <1><2a>: Abbrev Number:
// 5 (DW_TAG_member)", of an attribute "    <2b>   DW_AT_name        : (indirect string, offset: 0x1a3): lit".
function debug_entries(bytes) {
    const at = new Map(), open = [];
    let entry;
    for (let from = 0, end; from < bytes.length; from = end + 1) {
        end = bytes.indexOf(NEWLINE, from);
        if (end < 0)
            end = bytes.length;
        if (bytes[from] !== BLANK)
            continue;
        if (bytes[from + 1] === LESS) {
            const m = /^ <(\d+)><([0-9a-f]+)>: Abbrev Number: \d+ \(DW_TAG_(\w+)\)/
                .exec(bytes.latin1Slice(from, end));
            if (!m)
                continue;
            if (UNUSED.test(m[3])) {
                entry = undefined;
                continue;
            }
            const depth = Number(m[1]);
            entry = { tag: m[3], inside: [] };
            at.set(parseInt(m[2], 16), entry);
            open.length = depth;
            if (depth)
                open[depth - 1].inside.push(entry);
            open[depth] = entry;
            continue;
        }
        let name = from;
        while (name < end && bytes[name] !== 0x44) // D: offsets have small letters
            name++;
        name += 'DW_AT_'.length;
        let past = name;
        while (past < end && bytes[past] !== BLANK && bytes[past] !== COLON)
            past++;
        const attribute = entry && past < end && bytes.latin1Slice(name, past);
        if (!ATTRIBUTES.has(attribute))
            continue;
        const m = /^ *: (.*)$/.exec(bytes.latin1Slice(past, end));
        const type = m && /^<0x([0-9a-f]+)>/.exec(m[1]);
        if (m)
            entry[attribute] = type ? parseInt(type[1], 16) : m[1].replace(/^\(indirect.*?\): /, '').trim();
    }
    return at;
}
// Those of functions and of const tables: { from or table, offset, type, name }
function read_relocations(bytes) {
    const found = [];
    let from, table;
    for (const line of bytes.toString('latin1').split('\n')) {
        const section = /^RELOCATION RECORDS FOR \[(.*)\]/.exec(line)?.[1];
        if (section !== undefined) {
            from = /^\.text\.(?:unlikely\.|hot\.)?(.*)$/.exec(section)?.[1];
            table = /^\.(?:rodata|data|data\.rel\.ro|data\.rel\.ro\.local)\.(.*)$/.exec(section)?.[1];
        }
        const m = from || table ? /^([0-9a-f]+) (R_ARM_\w+) +([^.\s][^\s+]*)/.exec(line) : null;
        if (m)
            found.push({ from, table, offset: parseInt(m[1], 16), type: m[2], name: m[3] });
    }
    return found;
}
// The call graph: nodes { name, bytes, kind }, edges { from, to, file, line, column }
function read_graph(name, lines) {
    const title = (s) => (s.includes(':') ? `${name}:${s.slice(s.lastIndexOf(':') + 1)}` : s);
    const nodes = [], edges = [];
    for (const line of lines) {
        let m = /^node: \{ title: "([^"]*)".*?(\d+) bytes \(([a-z,]*)\)/.exec(line);
        if (m)
            nodes.push({ title: m[1], name: title(m[1]), bytes: Number(m[2]), kind: m[3] });
        m = /^edge: \{ sourcename: "([^"]*)" targetname: "([^"]*)"(?: label: "(.*):(\d+):(\d+)")?/.exec(line);
        if (m)
            edges.push({ from: title(m[1]), to: title(m[2]), indirect: m[2] === '__indirect_call', file: m[3],
                line: Number(m[4]), column: Number(m[5]) });
    }
    return { nodes, edges };
}

const there = new Map();
function exists(file) {
    if (!there.has(file))
        there.set(file, fs.existsSync(file));
    return there.get(file);
}
// OBJECT, and what readelf and objdump say of it
function read_unit(object, debug, relocations) {
    const unit = { object, name: path.basename(object, '.o'), at: debug_entries(debug),
        relocations: read_relocations(relocations), variables: new Map(), functions: new Map(),
        local_functions: new Set(), global_functions: new Set() };
    // The type itself, without typedef and const
    unit.bare = (offset) => {
        let type = unit.at.get(offset);
        while (type && /^(typedef|const_type|volatile_type)$/.test(type.tag))
            type = unit.at.get(type.type);
        return type;
    };
    unit.is_code = (offset) => { // a pointer to a function
        const type = unit.bare(offset);
        return type?.tag === 'pointer_type' && unit.bare(type.type)?.tag === 'subroutine_type';
    };
    // Members, those of structs without a name too: { name, type, offset }
    unit.members = (struct, offset = 0) => struct.inside.filter((m) => m.tag === 'member').flatMap((m) => {
        const place = offset + Number(m.data_member_location || 0);
        return m.name ? [{ name: m.name, type: m.type, offset: place }] : unit.members(unit.bare(m.type), place);
    });
    for (const [, entry] of unit.at) {
        const of = entry.abstract_origin ?? entry.specification;
        const name = entry.name ?? unit.at.get(of)?.name;
        if (/^(variable|formal_parameter)$/.test(entry.tag) && entry.name && entry.type !== undefined)
            add(unit.variables, name, entry.type);
        if (entry.tag === 'subprogram' && name && !unit.functions.has(name) && entry.decl_line)
            unit.functions.set(name, entry);
    }
    unit.file = [...unit.at.values()].find((e) => e.tag === 'compile_unit').name;
    unit.graph = read_graph(unit.name, fs.readFileSync(object.replace(/\.o$/, '.su'), 'latin1').split('\n'));
    unit.own = fs.readFileSync(object.replace(/\.o$/, '.d'), 'utf8').split(/[\s\\]+/).slice(1)
        .filter((f) => f && !f.startsWith('/') && exists(f)); // its sources
    return unit;
}
// What a tool has said of each of these files, bytes by file. It begins with a line that has BEFORE, the file, AFTER.
function said_of(files, before, after, answer) {
    const bytes = fs.readFileSync(answer), said = new Map();
    let now, from = 0;
    for (const file of files.length > 1 ? files : []) {
        const at = bytes.indexOf(`\n${before}${file}${after}`, from, 'latin1');
        if (at < 0)
            throw new Error(`${answer} says nothing of ${file}`);
        if (now)
            said.set(now, bytes.subarray(from, at));
        now = file;
        from = at + 1;
    }
    return said.set(now ?? files[0], bytes.subarray(from));
}
// Folders, and of each its units and what is said of its program. Folders that differ in a few objects share the
// others: one is read once, by its bytes.
function read_folders(dirs) {
    const fresh = new Map(), known = new Map(), elves = dirs.map((dir) => path.join(dir, 'all.elf'));
    const keys_in = dirs.map((dir) => fs.readdirSync(dir).filter((one) => one.endsWith('.o')).map((f) => {
        const object = path.join(dir, f), su = object.replace(/\.o$/, '.su');
        const key = f + createHash('sha1').update(fs.readFileSync(object)).update(fs.readFileSync(su)).digest('hex');
        if (!fresh.has(key))
            fresh.set(key, object);
        return key;
    }));
    const objects = [...fresh.values()];
    const answers = [
        ask('readelf', ['--debug-dump=info'], objects), ask('objdump', ['-r'], objects),
        ask('nm', ['--plugin=', '-A'], objects),
        ask('nm', ['--plugin='], elves), ask('objdump', ['-d', '--no-show-raw-insn'], elves),
    ];
    const relocations = said_of(objects, '', ':', answers[1]);
    for (const [object, debug] of said_of(objects, 'File: ', '\n', answers[0]))
        known.set(object, read_unit(object, debug, relocations.get(object)));
    for (const line of fs.readFileSync(answers[2], 'latin1').split('\n')) {
        const m = /^(.*?):[0-9a-f]* *([tTwW]) ([^$.]\S*)$/.exec(line);
        if (m)
            known.get(m[1])[m[2] === 't' ? 'local_functions' : 'global_functions'].add(m[3]);
    }
    const names = said_of(elves, '', ':', answers[3]), code = said_of(elves, '', ':', answers[4]);
    return new Map(dirs.map((dir, n) => [dir, { units: keys_in[n].map((key) => known.get(fresh.get(key))),
        names: names.get(elves[n]), code: code.get(elves[n]) }]));
}

// Fields and variables that hold functions and that an expression like a->b.c may mean: their keys. [] where none does.
const CHAIN = String.raw`[A-Za-z_]\w*(?:\s*(?:->|\.)\s*[A-Za-z_]\w*|\[[^\[\]]*\])*`;
function keys_of(unit, chain) {
    const steps = chain.match(/[A-Za-z_]\w*(?![^\[]*\])|\[[^\[\]]*\]/g);
    let now = [...(unit.variables.get(steps[0]) ?? [])].map((type) => ({ type, key: `${unit.name}:${steps[0]}` }));
    for (const step of steps.slice(1)) {
        now = now.flatMap(({ type }) => {
            let of = unit.bare(type);
            if (of?.tag === 'pointer_type' || of?.tag === 'array_type')
                type = of.type;
            if (step[0] === '[')
                return [{ type }];
            of = unit.bare(type);
            if (!/^(structure|union)_type$/.test(of?.tag))
                return [];
            return unit.members(of).filter((m) => m.name === step)
                .map((m) => ({ type: m.type, key: `${of.name}.${step}`, struct: of.name }));
        });
    }
    return now.filter(({ type, key }) => key && unit.is_code(type)).map(({ key, struct }) => ({ key, struct }));
}

const sources = new Map(); // FILE -> its text without comments and directives, places unchanged
function source(file) {
    if (!sources.has(file))
        sources.set(file, fs.readFileSync(file, 'utf8')
            .replace(/\/\*[\s\S]*?\*\/|\/\/[^\n]*/g, (c) => c.replace(/[^\n]/g, ' ')));
    return sources.get(file);
}
// What FACT finds in a file, once for all units that have it
const once = (fact) => {
    const known_of = new Map();
    return (...args) => {
        const key = args.join(' ');
        if (!known_of.has(key))
            known_of.set(key, fact(...args));
        return known_of.get(key);
    };
};
const READ = new RegExp(`(${CHAIN})\\s*(\\(?)`, 'g');
const ASSIGNED = new RegExp(`(?<![\\w>.])(${CHAIN})\\s*=(?!=)([^;]*);`, 'g');
const DECLARED = /\(\s*\*\s*(?:const\s+)?(\w+)\s*\)\s*\([^()]*\)\s*=(?!=)([^;]*);/g;
// { to, value } of each assignment, declarations of pointers to functions among them
const assignments = once((file) => [ASSIGNED, DECLARED].flatMap((pattern) =>
    [...source(file).matchAll(pattern)].map((m) => ({ to: m[1], value: m[2] }))));
// Arguments of each call of a function in a file
const arguments_of = once((name, file) => {
    const text = source(file), all = [];
    for (const m of text.matchAll(new RegExp(`\\b${name}\\s*\\(`, 'g'))) {
        const given = [''];
        for (let at = m.index + m[0].length, depth = 1; at < text.length; at++) {
            depth += '([{'.includes(text[at]) ? 1 : ')]}'.includes(text[at]) ? -1 : 0;
            if (!depth)
                break;
            if (text[at] === ',' && depth === 1)
                given.push('');
            else
                given[given.length - 1] += text[at];
        }
        all.push(given);
    }
    return all;
});
// Whether anything is wrong with a folder. Arguments are a line's of LIST; say takes a line of what is found.
function analyse(NAME, DIR, LIMIT, PREFIX, outside_list, EMPTY, SHOWN, say) {
    const OUTSIDE = new Set(outside_list.split(','));
    let failed = false;
    const fail = (what, why) => {
        say(`FAILED ${NAME} ${what}: ${why}`);
        failed = true;
    };

    // ---- Facts --------------------------------------------------------------------------------------

    const { units, names: symbols, code } = folders.get(DIR);
    const frame = new Map(); // FUNCTION -> bytes; static ones are UNIT:NAME, as two units may have one of a name
    const calls = new Map(); // FUNCTION -> those that it calls
    const pointers = [];     // { from, unit, file, line, column }
    const holds = new Map(); // KEY -> functions, and @KEY for what is copied to it
    const taken = new Map(); // function whose address code takes -> a function that does
    const of_tables = [];    // { unit, table, offset, target }

    const global_functions = new Set(units.flatMap((unit) => [...unit.global_functions]));
    for (const unit of units) {
        unit.function = (name) => // by its name in the object; undefined: it is none of ours
            unit.local_functions.has(name) ? `${unit.name}:${name}` : global_functions.has(name) ? name : undefined;
    }

    for (const unit of units) {
        for (const { title, name, bytes, kind } of unit.graph.nodes) {
            frame.set(name, bytes);
            if (kind !== 'static')
                fail('fixed frames', `${title} ${kind}`);
        }
        for (const { from, to, indirect, file, line, column } of unit.graph.edges) {
            if (indirect)
                pointers.push({ from, unit, file, line, column });
            else
                add(calls, from, to);
        }
        for (const { from, table, offset, type, name } of unit.relocations) {
            const target = unit.function(name);
            if (from && /^R_ARM_THM_(CALL|JUMP)/.test(type))
                add(calls, unit.function(from), target ?? name);
            else if (target && from)
                taken.set(target, from);
            else if (target && table)
                of_tables.push({ unit, table, offset, target });
        }
    }

    // What stands at an offset of a table: its key, or undefined.
    function field_at(unit, type, offset) {
        const of = unit.bare(type);
        if (of?.tag === 'array_type') {
            const element = unit.bare(of.type);
            return field_at(unit, of.type, offset % Number(element.byte_size ?? 4));
        }
        if (of?.tag !== 'structure_type')
            return undefined;
        const m = unit.members(of).filter((one) => one.offset <= offset).at(-1);
        if (m && m.offset === offset && unit.is_code(m.type))
            return `${of.name}.${m.name}`;
        return m && field_at(unit, m.type, offset - m.offset);
    }
    for (const { unit, table, offset, target } of of_tables) {
        const types = unit.variables.get(table.replace(/\.\d+$/, '')) ?? [];
        const found = [...types].map((type) => field_at(unit, type, offset)).filter(Boolean);
        if (!found.length)
            fail('tables', `${unit.name}: no field of ${table} at ${offset} that could hold ${target}`);
        found.forEach((key) => add(holds, key, target));
    }

    // ---- What the source assigns --------------------------------------------------------------------

    // What an expression may give: functions that it names, what it reads, what functions return that it calls.
    function values(unit, text, to) {
        for (const m of text.matchAll(READ)) {
            const fn = unit.function(m[1]);
            if (m[2] && unit.is_code(unit.functions.get(m[1])?.type))
                add(holds, to, `@return of ${unit.name}:${m[1]}`);
            else if (!m[2] && fn)
                add(holds, to, fn);
            else if (!m[2])
                keys_of(unit, m[1]).forEach(({ key }) => add(holds, to, `@${key}`));
        }
    }
    for (const unit of units) {
        for (const file of unit.own)
            for (const { to, value } of assignments(file))
                keys_of(unit, to).forEach(({ key }) => values(unit, value, key));
        for (const [name, entry] of unit.functions) {
            const parameters = entry.inside.filter((p) => p.tag === 'formal_parameter');
            parameters.forEach((parameter, n) => {
                if (unit.is_code(parameter.type) && parameter.name)
                    for (const file of unit.own)
                        for (const given of arguments_of(name, file))
                            values(unit, given[n] ?? '', `${unit.name}:${parameter.name}`);
            });
        }
        const lines = source(unit.file).split('\n');
        for (const [name, entry] of unit.functions)
            if (unit.is_code(entry.type) && Number(entry.decl_file) === 1) {
                const from = Number(entry.decl_line), end = lines.findIndex((l, n) => n >= from && l.startsWith('}'));
                for (const m of lines.slice(from, end).join('\n').matchAll(/\breturn\b([^;]*);/g))
                    values(unit, m[1], `return of ${unit.name}:${name}`);
            }
    }

    // Functions that a key may hold, and the keys that it has them from.
    function functions_in(key, seen) {
        if (seen.has(key))
            return [];
        seen.add(key);
        return [...(holds.get(key) ?? [])]
            .flatMap((one) => (one[0] === '@' ? functions_in(one.slice(1), seen) : [one]));
    }
    const sinks = new Set();
    let never = 0;
    for (const { from, unit, file, line, column } of pointers) {
        const here = `${file}:${line}:${column}`;
        const text = source(file).split('\n')[line - 1];
        const called = (part) => [...part.matchAll(new RegExp(`(?<![\\w>.])(${CHAIN})(?=\\s*\\()`, 'g'))]
            .flatMap((m) => keys_of(unit, m[1]));
        const first = text.slice(column - 1).match(new RegExp(`^${CHAIN}(?=\\s*\\()`))?.[0];
        let keys = first ? keys_of(unit, first) : [];
        if (!keys.length)
            keys = called(text); // anything in this line
        if (!keys.length)
            fail('pointer calls', `${here}: what is called in "${text.trim()}"?`);
        const outside = ({ key, struct }) => OUTSIDE.has(struct) || OUTSIDE.has(key);
        if (keys.some(outside))
            sinks.add(from);
        for (const { key } of keys.filter((one) => !outside(one))) {
            const seen = new Set();
            const to = functions_in(key, seen);
            if (!to.length && ![...seen].some((one) => EMPTY.split(',').some((field) => one.startsWith(field))))
                fail('pointer calls', `${here}: nothing fills ${key}`);
            never += !to.length;
            to.filter((fn) => !REFUSED.get(from)?.includes(fn)).forEach((fn) => add(calls, from, fn));
        }
    }
    const held = new Set([...holds.values()].flatMap((set) => [...set]));
    for (const [fn, by] of taken)
        if (!held.has(fn))
            fail('pointer calls', `${by} takes the address of ${fn}, which no field or variable is known to hold`);

    // ---- Libraries ------------------------------------------------------------------------------------

    // FUNCTION -> bytes, of what a program has beside ours
    function measure_helpers() {
        const names = new Map(), own = new Map(), callees = new Map(), address = new Map(), deepest = new Map();
        for (const line of symbols.toString('latin1').split('\n')) {
            const m = /^(\S+) [tTwW] (\S+)$/.exec(line); // __aeabi_idiv and __divsi3 are one place
            if (m)
                add(names, m[1], m[2]);
        }
        let f = '';
        for (const line of code.toString('latin1').split('\n')) {
            let m = /^([0-9a-f]+) <(.*)>:$/.exec(line);
            if (m) {
                f = m[2];
                address.set(f, m[1]);
                own.set(f, 0);
                continue;
            }
            const take = (bytes) => own.set(f, own.get(f) + bytes);
            if (/^ +[0-9a-f]+:\s+(push|stm(db|fd)\S*\s+sp!)/.test(line)) {
                for (const one of /\{(.*)\}/.exec(line)[1].split(',')) {
                    const [, a, b] = /r(\d+)-r(\d+)/.exec(one) ?? [];
                    take(a ? 4 * (b - a + 1) : 4);
                }
            } else if ((m = /^ +[0-9a-f]+:\s+sub\S*\s+sp,.*#(\d+)/.exec(line)) || (m = /\[sp, #-(\d+)\]!/.exec(line)))
                take(Number(m[1]));
            else if ((m = /^ +[0-9a-f]+:\s+b\S*\s.*<([^>+]+)>/.exec(line)) && m[1] !== f)
                add(callees, f, m[1]);
        }
        // What is one piece of assembler has no frame in the compiler's eyes
        for (const [fn, bytes] of frame)
            if (!bytes)
                frame.set(fn, own.get(fn.slice(fn.indexOf(':') + 1)) ?? 0);
        const deep = (fn, level) => {
            if (level > 20)
                return 100000;
            if (!deepest.has(fn))
                deepest.set(fn, (own.get(fn) ?? 0) +
                    Math.max(0, ...[...(callees.get(fn) ?? [])].map((c) => deep(c, level + 1))));
            return deepest.get(fn);
        };
        const out = new Map();
        for (const [fn, place] of address)
            if (!frame.has(fn))
                for (const alias of names.get(place) ?? [fn])
                    out.set(alias, deep(fn, 0));
        return out;
    }
    const helper = measure_helpers();

    // ---- The bound ------------------------------------------------------------------------------------

    const bounds = new Map(), next_of = new Map(), open = [];
    function bound(fn) {
        if (bounds.has(fn))
            return bounds.get(fn);
        if (open.includes(fn)) {
            fail('no recursion', [...open.slice(open.indexOf(fn)), fn].join(' -> '));
            return 0;
        }
        if (!frame.has(fn)) {
            if (!helper.has(fn))
                fail('known calls', `${fn} has no known frame`);
            bounds.set(fn, helper.get(fn) ?? 0);
            return bounds.get(fn);
        }
        open.push(fn);
        let most = 0;
        for (const callee of calls.get(fn) ?? []) {
            const deep = bound(callee);
            if (deep > most) {
                most = deep;
                next_of.set(fn, callee);
            }
        }
        open.pop();
        bounds.set(fn, frame.get(fn) + most);
        return bounds.get(fn);
    }
    for (const fn of frame.keys())
        bound(fn);
    const worst = [...frame.keys()].filter((fn) => fn.startsWith(PREFIX))
        .sort((a, b) => bounds.get(b) - bounds.get(a))[0];
    for (const fn of SHOWN)
        if (frame.has(fn))
            say(`note ${NAME} ${fn}: ${bounds.get(fn)} bytes` +
                (sinks.has(fn) ? ', and what the caller\'s functions take' : ''));
    for (const fn of new Set([SHOWN[0], worst])) {
        let steps = '';
        for (let f = fn; f; f = next_of.get(f))
            steps += ` ${f}(${frame.get(f) ?? helper.get(f)})`;
        say(`note ${NAME} deepest:${steps}`);
    }
    if (!failed)
        say(`ok ${NAME} no recursion, fixed frames, ${pointers.length} pointer calls accounted for` +
            (never ? `, ${never} of them to what nothing fills` : ''));
    if (!bounds.get(SHOWN[0]) || !pointers.length)
        fail('bound', `${SHOWN[0]}, or its calls, not found`);
    else if (bounds.get(worst) > Number(LIMIT))
        fail(`stack within ${LIMIT} bytes`, `${worst} takes ${bounds.get(worst)}`);
    else
        say(`ok ${NAME} stack within ${LIMIT} bytes: ` +
            (worst === SHOWN[0] ? '' : `${worst} ${bounds.get(worst)}, `) +
            `${SHOWN[0]} ${bounds.get(SHOWN[0])}`);
    return failed;
}

const list = fs.readFileSync(0, 'utf8').split('\n').filter(Boolean).map((line) => line.split(/ +/));
const folders = read_folders(list.map(([, dir]) => dir));
for (const [name, dir, limit, prefix, outside, empty, ...shown] of list) {
    const found = [];
    if (analyse(name.replaceAll('_', ' '), dir, limit, prefix, outside, empty, shown, (text) => found.push(text)))
        process.exitCode = 1;
    fs.writeFileSync(path.join(dir, 'bound.txt'), found.map((text) => `${text}\n`).join(''));
}
