// Scripts here export run(ARGUMENTS), which returns what is to be printed: many.mjs takes many of them. Alone, as
// `node SCRIPT ARGUMENTS...`, they print it.
//
// SPDX-License-Identifier: MIT
import fs from 'node:fs';
import { fileURLToPath } from 'node:url';

export function alone(url, run) {
    if (fs.realpathSync(process.argv[1]) === fileURLToPath(url))
        process.stdout.write(run(process.argv.slice(2)));
}
