/** The WebAssembly module for typed events, which has the inference and its tables. */

import make from '@wasm/slipfront_events.mjs';
import address from '@wasm/slipfront_events.wasm?url';
import { compiled, instanceOf } from './binding';

export const eventModule = async () => instanceOf(make, await compiled(address));
