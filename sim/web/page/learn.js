import {make} from './dom.js';
export function buildCards(at) { at.append(make('p', {}, '...')); }
