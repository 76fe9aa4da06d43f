/* Making elements. SPDX-License-Identifier: MIT */

/** The element of an id. */
export const id = (name) => document.getElementById(name);

/** An element with properties, attributes (those with a dash), and children. */
export function make(tag, properties = {}, ...children) {
    const node = document.createElement(tag);
    for (const [key, value] of Object.entries(properties)) {
        if (key === 'style') node.style.cssText = value;
        else if (key.includes('-') || key === 'for' || key === 'role') node.setAttribute(key, value);
        else node[key] = value;
    }
    node.append(...children);
    return node;
}

/** 12,345 */
export const count = (n) => Math.round(n).toLocaleString('en-US');

/** Bytes, as a person says them. */
export const bytes = (n) =>
    n >= 1024 * 1024
        ? `${(n / 1048576).toFixed(n >= 10485760 ? 0 : 1)} MB`
        : n >= 10240
          ? `${Math.round(n / 1024)} KB`
          : n >= 1024
            ? `${(n / 1024).toFixed(1)} KB`
            : `${Math.round(n)} B`;

/** Call `what` once, `ms` after the last time that this was called. */
export function later(ms, what) {
    let timer = 0;
    return () => {
        clearTimeout(timer);
        timer = setTimeout(what, ms);
    };
}
