// node many.mjs FILE: runs by one process, which loads and compiles the emulator once. A line of FILE each: "TO SCRIPT
// ARGUMENTS..."; TO gets what `node SCRIPT ARGUMENTS...` prints, or the error that ended it.
//
// SPDX-License-Identifier: MIT
import fs from 'node:fs';

for (const line of fs.readFileSync(process.argv[2], 'utf8').split('\n').filter(Boolean)) {
    const [to, script, ...args] = line.split(' ');
    const { run } = await import(`./${script}`);
    try {
        fs.writeFileSync(to, run(args));
    } catch (error) {
        fs.writeFileSync(to, `${error.stack}\n`);
    }
}
