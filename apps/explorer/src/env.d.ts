declare module '@wasm/*.mjs' {
  const make: import('./engine/binding').Make;
  export default make;
}
declare module '@wasm/*.wasm?url' {
  const address: string;
  export default address;
}
declare module '@cases/*?raw' {
  const text: string;
  export default text;
}
declare module '@events' {
  const events: { events: import('./model/events').PublishedEvent[] };
  export default events;
}
