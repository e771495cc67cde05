/** The WebAssembly module for ruptures on a plane. */

import make from '@wasm/slipfront_plane.mjs';
import address from '@wasm/slipfront_plane.wasm?url';
import { compiled, instanceOf } from './binding';

export const planeModule = async () => instanceOf(make, await compiled(address));
