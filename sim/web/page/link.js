/* Settings in the page's address, after the #. SPDX-License-Identifier: MIT */

/** What the address holds, names to texts. */
export function readLink() {
    return Object.fromEntries(new URLSearchParams(location.hash.slice(1)));
}

/** Write names and values; undefined ones are left out. */
export function writeLink(values) {
    const kept = Object.entries(values).filter(([, v]) => v !== undefined && v !== '');
    const hash = new URLSearchParams(kept).toString();
    history.replaceState(null, '', `${location.pathname}${location.search}${hash ? '#' + hash : ''}`);
}
